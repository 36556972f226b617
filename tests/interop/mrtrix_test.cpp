// Files written by MRtrix3's own programs are read with equal coefficients and places; amplitudes equal those of its sh2amp.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <random>

#include "interop/programs.h"
#include "io/nifti_write.h"
#include "io/sh_image.h"
#include "math/sh_evaluate.h"
#include "unit/io/image_bytes.h"

namespace radiata::io {
namespace {

/// The values of all volumes by place in micrometres, so that reordered and flipped axes do not matter.
std::map<std::array<long, 3>, std::vector<float>> byPlace(const Volume& volume) {
    std::map<std::array<long, 3>, std::vector<float>> places;
    const auto [nx, ny, nz, volumes] = volume.size;
    for (std::int64_t z = 0; z < nz; ++z) {
        for (std::int64_t y = 0; y < ny; ++y) {
            for (std::int64_t x = 0; x < nx; ++x) {
                const glm::dvec3 p(volume.voxel_to_world *
                                   glm::dvec4(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z), 1));
                auto& values = places[{std::lround(p.x * 100), std::lround(p.y * 100), std::lround(p.z * 100)}];
                for (std::int64_t v = 0; v < volumes; ++v) {
                    values.push_back(volume.data[static_cast<std::size_t>(x + nx * (y + ny * (z + nz * v)))]);
                }
            }
        }
    }
    return places;
}

/// An oblique grid with a flipped first axis and unequal voxels.
glm::dmat4 obliqueMatrix() {
    const double c = std::cos(0.3), s = std::sin(0.3);
    return glm::dmat4(glm::dvec4(-1.5 * c, -1.5 * s, 0, 0), glm::dvec4(-2 * s, 2 * c, 0, 0), glm::dvec4(0, 0, 2.5, 0),
                      glm::dvec4(31.25, -7.5, 11, 1));
}

Volume image(std::array<std::int64_t, 4> size, const std::function<float(std::size_t)>& value) {
    Volume volume;
    volume.size = size;
    volume.voxel_to_world = obliqueMatrix();
    volume.data.resize(static_cast<std::size_t>(size[0] * size[1] * size[2] * size[3]));
    for (std::size_t i = 0; i < volume.data.size(); ++i) volume.data[i] = value(i);
    return volume;
}

TEST(MrtrixInterop, EveryTypeOrderAndFormatOfMrconvertIsRead) {
    test::requireMrtrix();
    const test::TempFolder folder;
    const std::string in = (folder.path() / "in.nii").string();
    // 0 to 100: every type but Bit holds them exactly.
    const Volume whole = image({7, 5, 4, 6}, [](std::size_t i) { return static_cast<float>(i * 37 % 101); });
    writeNifti(whole, in);
    const auto expected = byPlace(whole);
    const std::vector<std::string> types{"int8",     "uint8",    "int16le",   "int16be",   "uint16le",  "uint16be",
                                         "int32le",  "int32be",  "uint32le",  "uint32be",  "int64le",   "int64be",
                                         "uint64le", "uint64be", "float32le", "float32be", "float64le", "float64be"};
    const std::vector<std::string> strides{"1,2,3,4", "2,3,4,1", "-1,-2,3,4", "-4,2,-1,3", "3,-4,-2,-1"};
    const std::vector<std::string> names{"out.mif", "out.mif.gz", "out.mih"};
    for (std::size_t t = 0; t < types.size(); ++t) {
        for (const std::string& name : names) {
            const std::string& order = strides[(t + name.size()) % strides.size()];
            SCOPED_TRACE(types[t] + " " + order + " " + name);
            const std::string out = (folder.path() / name).string();
            test::run("mrconvert -quiet -force '" + in + "' -datatype " + types[t] + " -strides " + order + " '" + out + "'");
            EXPECT_EQ(byPlace(readVolume(out)), expected);
        }
    }
    for (const std::string order : {"1,2,3,4", "-1,2,3,4", "-1,-2,3,4", "3,1,-2,4"}) {
        for (const std::string type : {"int16", "float32", "float32be", "float64", "uint8"}) {
            for (const std::string name : {"out.nii", "out.nii.gz"}) {
                SCOPED_TRACE(type + " " + order + " " + name);
                const std::string out = (folder.path() / name).string();
                test::run("mrconvert -quiet -force '" + in + "' -datatype " + type + " -strides " + order + " '" + out + "'");
                EXPECT_EQ(byPlace(readVolume(out)), expected);
            }
        }
    }
}

TEST(MrtrixInterop, BitImagesAreRead) {
    test::requireMrtrix();
    const test::TempFolder folder;
    const std::string in = (folder.path() / "in.nii").string();
    const Volume mask = image({7, 5, 4, 1}, [](std::size_t i) { return i * 37 % 101 < 40 ? 1.0F : 0.0F; });
    writeNifti(mask, in);
    for (const std::string order : {"1,2,3", "3,-1,2"}) {
        for (const std::string name : {"out.mif", "out.mif.gz", "out.mih"}) {
            const std::string out = (folder.path() / name).string();
            test::run("mrconvert -quiet -force '" + in + "' -datatype bit -strides " + order + " '" + out + "'");
            EXPECT_EQ(byPlace(readVolume(out)), byPlace(mask)) << order << ' ' << name;
        }
    }
}

TEST(MrtrixInterop, AmplitudesAlong300DirectionsEqualSh2amp) {
    // Bound: 1e-5 of the largest amplitude, bands to 2, 4, 8, 12; MRtrix computes in float32.
    test::requireMrtrix();
    const test::TempFolder folder;
    std::mt19937 random(17);
    std::normal_distribution<double> normal;
    std::vector<glm::dvec3> directions;
    std::ofstream list(folder.path() / "directions.txt");
    list.precision(17);
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        directions.push_back(d);
        list << d.x << ' ' << d.y << ' ' << d.z << '\n';
    }
    list.close();
    for (const int lmax : {2, 4, 8, 12}) {
        const auto count = static_cast<std::int64_t>(ShLayout{lmax, false}.count());
        const Volume volume = image({4, 3, 2, count}, [&](std::size_t) { return static_cast<float>(normal(random)); });
        const std::string in = (folder.path() / "sh.nii").string();
        const std::string out = (folder.path() / "amplitudes.nii").string();
        writeNifti(volume, in);
        test::run("sh2amp -quiet -force '" + in + "' '" + (folder.path() / "directions.txt").string() + "' '" + out + "'");
        const auto theirs = byPlace(readVolume(out));
        const model::ShImage ours = readShImage(in, {.convention = {}, .axes = {}, .full = false});
        ASSERT_EQ(ours.voxels.size(), 24U);
        double largest = 0, worst = 0;
        for (std::size_t i = 0; i < ours.voxels.size(); ++i) {
            const glm::dvec3 p(ours.voxel_to_world * glm::dvec4(glm::dvec3(ours.voxels[i]), 1));
            const auto& amplitudes = theirs.at({std::lround(p.x * 100), std::lround(p.y * 100), std::lround(p.z * 100)});
            ASSERT_EQ(amplitudes.size(), directions.size());
            const auto function = std::span(ours.coefficients).subspan(i * ours.layout.count(), ours.layout.count());
            for (std::size_t d = 0; d < directions.size(); ++d) {
                const double theirs_along = static_cast<double>(amplitudes[d]);
                largest = std::max(largest, std::abs(theirs_along));
                worst = std::max(worst, std::abs(evaluateSh(ours.layout, function, directions[d]) - theirs_along));
            }
        }
        EXPECT_LT(worst, 1e-5 * largest) << "lmax " << lmax;
    }
}

}  // namespace
}  // namespace radiata::io
