// Writes small valid track files and selections as the seed corpus of the target "tracts": make_tract_corpus FOLDER.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "io/tractogram.h"
#include "unit/io/tract_bytes.h"
#include "unit/io/vtp_writer.h"

namespace {

using namespace radiata;
using namespace radiata::test;
namespace fs = std::filesystem;

void seed(const fs::path& folder, const std::string& name, char choice, const std::string& bytes) {
    std::ofstream file(folder / name, std::ios::binary);
    file << choice << bytes;
    if (!file.flush()) throw std::runtime_error("cannot write " + name);
}

std::string contentOf(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

std::string trx() {
    model::Tractogram tracts;
    tracts.header.vertex_columns = {{"fa", 1}};
    tracts.header.fibre_columns = {{"id", 2}};
    tracts.fibres.clear(1, 1);
    tracts.fibres.points = {{1, 2, 3}, {2, 2, 3}, {-4, 5, 6}};
    tracts.fibres.offsets = {0, 2, 3};
    tracts.fibres.vertex_values[0] = {0, 1, 2};
    tracts.fibres.fibre_values[0] = {1, 2, 3, 4};
    tracts.groups = {{"g", {1}, {{"v", 1}}, {{7}}}};
    const TempFolder folder;
    io::writeTractogram(*model::sourceOf(tracts), folder.path() / "a.trx");
    return contentOf(folder.path() / "a.trx");
}

void write(const fs::path& folder) {
    fs::create_directories(folder);
    for (const bool big : {false, true}) {
        const std::string order = big ? "BE" : "LE";
        seed(folder, "tck_float" + order, 0, tckBytes(tckLines("Float32" + order), twoTracks(), "float32", big));
        seed(folder, "tck_double" + order, 0, tckBytes(tckLines("Float64" + order), twoTracks(), "float64", big));
        TrkFile trk;
        trk.big = big;
        trk.scalar_names = {"fa"};
        trk.property_names = {"id"};
        trk.order = big ? "LPS" : "RAS";
        trk.data = trkTrack(2, {1, 1, 1, 0.5, 2, 2, 2, 0.25, 7}, big);
        seed(folder, "trk" + order, 1, trkBytes(trk));
    }
    seed(folder, "trx", 2, trx());
    seed(folder, "tt", 3, ttBytes());
    seed(folder, "tck_gz", 4, gzip(tckBytes(tckLines(), twoTracks())));
    seed(folder, "tt_gz", 5, gzip(ttBytes()));
    seed(folder, "tsf", 6,
         tckBytes({"mrtrix track scalars", "datatype: Float32LE", "file: . 200"}, {1, kNanNumber, 2, kNanNumber, kInfNumber}));
    seed(folder, "txt", 7, "# two\n1.5, 2\n3 nan\n");
    seed(folder, "vtk_text", 8, vtkText());
    seed(folder, "vtk_binary", 8, vtkBinary(true));
    seed(folder, "vtk_old", 8, vtkBinary(false));
    for (const std::string format : {"ascii", "binary", "appended"}) {
        for (const bool zlib : {false, true}) {
            VtpFile vtp;
            vtp.format = format;
            vtp.zlib = vtp.raw = vtp.big = zlib;
            vtp.pieces = zlib ? 2 : 1;
            seed(folder, "vtp_" + format + (zlib ? "_zlib" : ""), 9, vtpBytes(vtp));
        }
    }
    seed(folder, "selection", 10,
         "any sphere(1,2,3,4) and not (order(mask(a), box(0,0,0,1,1,1)) or column(\"x y\", -inf, 2, least))");
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::fprintf(stderr, "usage: make_tract_corpus FOLDER\n");
        return 2;
    }
    try {
        write(arguments[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_tract_corpus: %s\n", error.what());
        return 1;
    }
    return 0;
}
