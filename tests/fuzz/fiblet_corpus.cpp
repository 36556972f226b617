// Writes small valid .fiblet, .fiblet76 and .qfib files as the seed corpus of the target "fiblets": make_fiblet_corpus FOLDER.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <unistd.h>

#include "build/fiblet_encode.h"
#include "ingest/fiblet76_file.h"
#include "io/fiblet_file.h"
#include "io/qfib.h"
#include "support/random_fibres.h"

namespace {

using namespace radiata;

void seed(const std::filesystem::path& from, const std::filesystem::path& to, char choice) {
    std::ifstream in(from, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    std::ofstream file(to, std::ios::binary);
    file << choice << bytes;
    if (!file.flush()) throw std::runtime_error("cannot write " + to.string());
}

void write(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const std::filesystem::path one = folder.parent_path() / ("one_" + std::to_string(::getpid()));
    for (const std::size_t fibres : {1U, 3U, 20U}) {
        const test::Fibres points = test::randomFibres(41, fibres, 150, 0.1, 0.3);
        model::FibletSet set = encodeFiblets(points.points, points.offsets, {});
        set.fibre_columns = {{"weight", 2, std::vector<float>(2 * set.fibres(), 0.5F)}};
        set.point_columns = {{"fa", 0, std::vector<glm::vec2>(set.heads.size(), glm::vec2(0, 1)),
                              std::vector<std::uint8_t>(64 * set.heads.size(), 7)}};
        set.remarks = "Something was assumed.";
        set.groups = {{"left", {0}, {{"volume", 2}}, {{1.0F, 2.0F}}}};
        io::writeFiblets(set, one);
        seed(one, folder / ("fiblet_" + std::to_string(fibres)), 1);
        seed(one, folder / ("repaired_" + std::to_string(fibres)), 2);
    }
    model::Tractogram tractogram;
    std::mt19937 random(42);
    tractogram.fibres.points = test::randomFibre(random, 30, 0.1, 0.2);
    tractogram.fibres.offsets = {0, 10, 30};
    for (const int bits : {8, 16}) {
        io::writeQfib([&] { return model::sourceOf(tractogram); }, bits, one);
        seed(one, folder / ("qfib_" + std::to_string(bits)), 0);
    }
    ingest::writeFiblet76([&] { return model::sourceOf(tractogram); }, {}, one);
    seed(one, folder / "fiblet76", 3);
    std::filesystem::remove(one);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_fiblet_corpus FOLDER\n");
        return 2;
    }
    write(argv[1]);
    return 0;
}
