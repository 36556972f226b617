// Any bytes given to the readers of streamlines and selections: they either read them or throw Error, and what they read is
// consistent. The first byte chooses what the rest is: the name's ending, or a selection's text.
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/error.h"
#include "io/tractogram.h"
#include "model/selection_text.h"

namespace {

namespace fs = std::filesystem;
using namespace radiata;

constexpr std::string_view kEndings[] = {".tck", ".trk", ".trx", ".tt", ".tck.gz", ".tt.gz", ".tsf", ".txt", ".vtk", ".vtp"};

/// The folder of this process' input files; removed at exit.
class Folder {
public:
    Folder() : path_(fs::temp_directory_path() / ("radiata_fuzz_tracts_" + std::to_string(::getpid()))) {
        fs::create_directories(path_);
        // Two tracks of one point each, for columns to belong to.
        std::ofstream file(path_ / "tracks.tck", std::ios::binary);
        file << "mrtrix tracks\ndatatype: Float32LE\nfile: . 64\nEND\n";
        file << std::string(64 - static_cast<std::size_t>(file.tellp()), '\n');
        const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
        const float numbers[] = {1, 2, 3, nan, nan, nan, 4, 5, 6, nan, nan, nan, inf, inf, inf};
        file.write(reinterpret_cast<const char*>(numbers), sizeof(numbers));
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "broken: %s\n", what);
    std::abort();
}

void check(const model::Tractogram& tracts) {
    const model::FibreBatch& all = tracts.fibres;
    require(all.offsets.front() == 0 && all.offsets.back() == all.points.size(), "offsets cover the points");
    for (std::size_t f = 0; f < tracts.fibreCount(); ++f) require(all.offsets[f] <= all.offsets[f + 1], "offsets ascend");
    for (const glm::vec3& p : all.points) {
        require(glm::all(glm::lessThanEqual(glm::abs(p), glm::vec3(model::kCoordinateMaxMm))), "coordinates are usable");
    }
    for (std::size_t c = 0; c < all.vertex_values.size(); ++c) {
        const auto n = static_cast<std::size_t>(tracts.header.vertex_columns[c].components);
        require(all.vertex_values[c].size() == n * all.points.size(), "values for each vertex");
    }
    for (std::size_t c = 0; c < all.fibre_values.size(); ++c) {
        const auto n = static_cast<std::size_t>(tracts.header.fibre_columns[c].components);
        require(all.fibre_values[c].size() == n * tracts.fibreCount(), "values for each fibre");
    }
    for (const model::FibreGroup& group : tracts.groups) {
        for (const std::uint32_t fibre : group.fibres) require(fibre < tracts.fibreCount(), "groups of fibres that are there");
    }
}

void readFile(const fs::path& path, bool column) {
    io::TractOptions options;
    if (column) options.columns = {path};
    check(model::readAll(*io::openTractogram(column ? path.parent_path() / "tracks.tck" : path, options), 1U << 28));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Folder folder;
    if (size == 0) return 0;
    const std::size_t choice = data[0] % (std::size(kEndings) + 1);
    const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        if (choice == std::size(kEndings)) {
            const model::Selection selection = model::parseSelection(rest);
            for (const model::FibreRegion& region : selection.regions)
                require(!model::regionText(region).empty(), "a region's text");
            return 0;
        }
        const fs::path path = folder.path() / ("input" + std::string(kEndings[choice]));
        std::ofstream(path, std::ios::binary | std::ios::trunc) << rest;
        readFile(path, choice == 6 || choice == 7);
    } catch (const Error& error) {
        require(error.code() != Code::kInternal, "no input is a bug of ours");
    }
    return 0;
}
