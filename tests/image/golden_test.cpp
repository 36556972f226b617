// Pictures that people have looked at are drawn again. On the driver that drew them every pixel counts, within a tolerance
// measured over the code paths of the software rasteriser; on another driver what is seen where, and the mean colour.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include <nlohmann/json.hpp>

#include "image/fixture.h"
#include "image/golden_pictures.h"

namespace radiata::test {
namespace {

namespace fs = std::filesystem;

constexpr int kChannel = 2;                           // of 255
constexpr int kPixelsAtLeast = 4;                     // of 19,200: what processors that nobody measured may add at silhouettes
constexpr int kPixelsAtMost = 19;                     // 0.1 %
const char* const kWidths[] = {"128", "256", "512"};  // LP_NATIVE_VECTOR_WIDTH: SSE, AVX2, AVX-512

const fs::path kGoldens = fs::path(RADIATA_SOURCE_DIR) / "tests" / "image" / "goldens";
const fs::path kOut = RADIATA_IMAGE_OUT;

bool asked(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && std::string(value) == "1";
}

Drawn readDrawn(const fs::path& folder, const std::string& name) {
    return {readPng(folder / (name + ".png")), readPng(folder / (name + ".ids.png"))};
}

void writeDrawn(const fs::path& folder, const std::string& name, const Drawn& drawn) {
    writePng(folder / (name + ".png"), drawn.picture);
    writePng(folder / (name + ".ids.png"), drawn.ids);
}

nlohmann::json readJson(const fs::path& path) {
    std::ifstream file(path);
    return nlohmann::json::parse(file);
}

void writeJson(const fs::path& path, const nlohmann::json& json) {
    std::ofstream file(path);
    file << json.dump(4) << '\n';
}

/// This program again with another vector width, in a process of its own, because the driver reads the width when it starts.
/// \return the folder with the pictures and device.txt
fs::path drawWithWidth(const std::string& width) {
    const fs::path folder = kOut / ("width" + width);
    fs::remove_all(folder);
    const std::string command = "LP_NATIVE_VECTOR_WIDTH=" + width + " RADIATA_PICTURES='" + folder.string() + "' '" +
                                fs::read_symlink("/proc/self/exe").string() +
                                "' --gtest_filter=GoldenPictures.AreWrittenAndReadBack --gtest_brief=1 >/dev/null </dev/null";
    if (std::system(command.c_str()) != 0) throw Error(Code::kInternal, "this failed: " + command);
    return folder;
}

std::string firstLine(const fs::path& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    return line;
}

class GoldenPictures : public ImageTest {
protected:
    /// Compares with the golden picture; writes actual, expected and difference where they differ.
    void hold(const std::string& name, const Drawn& actual, const std::string& what) {
        const nlohmann::json sidecar = readJson(kGoldens / (name + ".json"));
        const Drawn expected = readDrawn(kGoldens, name);
        ASSERT_EQ(expected.picture.rgba.size(), actual.picture.rgba.size());
        const Tolerance tolerance{sidecar.at("channel"), sidecar.at("pixels"), sidecar.at("ids")};
        const Difference found = difference(expected, actual, tolerance.channel);
        const Structure seen = structure(expected, actual);
        const bool same_driver = sidecar.at("driver") == device.info().driver;
        if (!same_driver) {
            std::printf("%s: drawn by '%s', kept by '%s': structure is compared only\n", name.c_str(),
                        device.info().driver.c_str(), sidecar.at("driver").get<std::string>().c_str());
        }
        std::printf("%s%s: worst channel %d, %d pixels beyond %d, %d other ids; silhouette %.4f, ids %.4f, mean %.4f\n",
                    name.c_str(), what.c_str(), found.worst_channel, found.pixels, tolerance.channel, found.ids,
                    seen.silhouette, seen.ids, seen.mean_difference);
        if (alike(seen) && (!same_driver || within(found, tolerance))) return;
        const std::string file = (kOut / (name + what)).string();
        writePng(file + ".actual.png", actual.picture);
        writePng(file + ".expected.png", expected.picture);
        writePng(file + ".difference.png", differencePicture(expected.picture, actual.picture));
        ADD_FAILURE() << name << what << " differs from the golden picture: see " << file
                      << ".{actual,expected,difference}.png; if it is right, RADIATA_BLESS=1 keeps it";
    }

    void bless() {
        std::map<std::string, fs::path> folders;
        for (const char* width : kWidths) folders[width] = drawWithWidth(width);
        for (const std::string& name : goldenNames()) {
            const Drawn drawn = drawGolden(name, store, renderer);
            nlohmann::json sidecar;
            Tolerance tolerance{kChannel, kPixelsAtLeast, kPixelsAtLeast};
            for (const char* width : kWidths) {
                const Difference found = difference(drawn, readDrawn(folders[width], name), kChannel);
                tolerance.pixels = std::max(tolerance.pixels, 2 * found.pixels);
                tolerance.ids = std::max(tolerance.ids, 2 * found.ids);
                sidecar["measured"].push_back({{"LP_NATIVE_VECTOR_WIDTH", std::stoi(width)},
                                               {"device", firstLine(folders[width] / "device.txt")},
                                               {"worst_channel", found.worst_channel},
                                               {"pixels", found.pixels},
                                               {"ids", found.ids}});
            }
            ASSERT_LE(std::max(tolerance.pixels, tolerance.ids), kPixelsAtMost) << name << " depends on the code path";
            sidecar["driver"] = device.info().driver;
            sidecar["channel"] = tolerance.channel;
            sidecar["pixels"] = tolerance.pixels;
            sidecar["ids"] = tolerance.ids;
            sidecar["note"] =
                "tolerance: twice what was measured between the code paths of the driver, at least 4 of 19200 pixels";
            writeDrawn(kGoldens, name, drawn);
            writeJson(kGoldens / (name + ".json"), sidecar);
        }
    }
};

TEST_F(GoldenPictures, AreDrawnAgain) {
    if (asked("RADIATA_BLESS")) {
        bless();
        return;
    }
    for (const std::string& name : goldenNames()) hold(name, drawGolden(name, store, renderer), "");
}

TEST_F(GoldenPictures, AreWrittenAndReadBack) {
    const char* named = std::getenv("RADIATA_PICTURES");
    const fs::path folder = named != nullptr ? fs::path(named) : kOut / "pictures";
    for (const std::string& name : goldenNames()) {
        const Drawn drawn = drawGolden(name, store, renderer);
        writeDrawn(folder, name, drawn);
        const Drawn back = readDrawn(folder, name);
        EXPECT_EQ(drawn.picture.rgba, back.picture.rgba) << name;
        EXPECT_EQ(drawn.ids.rgba, back.ids.rgba) << name;
    }
    std::ofstream(folder / "device.txt") << device.info().name << '\n';
}

TEST_F(GoldenPictures, HoldOnTheOtherCodePathsOfTheDriver) {
    for (const char* width : {"128", "512"}) {
        const fs::path folder = drawWithWidth(width);
        std::printf("%s\n", firstLine(folder / "device.txt").c_str());
        for (const std::string& name : goldenNames()) hold(name, readDrawn(folder, name), std::string("-width") + width);
    }
}

TEST_F(GoldenPictures, NoticeOneShiftedGlyph) {
    const nlohmann::json sidecar = readJson(kGoldens / "axial_slice.json");
    const Tolerance tolerance{sidecar.at("channel"), sidecar.at("pixels"), sidecar.at("ids")};
    const Drawn expected = readDrawn(kGoldens, "axial_slice");
    const Drawn shifted = drawGolden("axial_slice", store, renderer, true);
    const Difference found = difference(expected, shifted, tolerance.channel);
    const Structure seen = structure(expected, shifted);
    std::printf("one of the glyphs moved by a voxel: %d pixels and %d ids differ; silhouette %.4f, ids %.4f\n", found.pixels,
                found.ids, seen.silhouette, seen.ids);
    EXPECT_FALSE(within(found, tolerance));
    EXPECT_GT(found.pixels, 2 * tolerance.pixels);
}

TEST_F(GoldenPictures, NoticeAMirroredPictureByStructureAlone) {
    const Drawn expected = readDrawn(kGoldens, "axial_slice");
    Drawn mirrored = expected;
    for (encode::Picture* picture : {&mirrored.picture, &mirrored.ids}) {
        for (int y = 0; y < picture->height; ++y) {
            auto* row = reinterpret_cast<std::uint32_t*>(picture->rgba.data()) + y * picture->width;
            std::reverse(row, row + picture->width);
        }
    }
    EXPECT_FALSE(alike(structure(expected, mirrored)));
    EXPECT_TRUE(alike(structure(expected, expected)));
}

}  // namespace
}  // namespace radiata::test
