// The pictures that are kept, how they are compared with what is drawn now, and how they are replaced.
// Each has three files in tests/image/goldens: NAME.png, NAME.ids.png (1 + number of the stored voxel as a 24-bit colour, 0:
// nothing) and NAME.json (driver, tolerance, what the tolerance was measured on). Replacing them is asked for with
// RADIATA_BLESS=1, after looking at the pictures that a failed comparison wrote.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "encode/picture.h"
#include "render/frame/renderer.h"
#include "store/store.h"

namespace radiata::test {

/// What a golden picture holds.
struct Drawn {
    encode::Picture picture;
    encode::Picture ids;
};

/// Names of all golden pictures.
std::vector<std::string> goldenNames();
/// Draws one, 160x120. \param shift_one_glyph  moves one glyph to the empty voxel next to it: a picture that must not pass
Drawn drawGolden(const std::string& name, store::Store& store, render::Renderer& renderer, bool shift_one_glyph = false);

struct Tolerance {
    int channel = 0;  ///< largest difference of a colour channel that does not count
    int pixels = 0;   ///< how many pixels may differ by more
    int ids = 0;      ///< how many pixels may show another glyph
};

/// The same driver drew both: every pixel counts.
struct Difference {
    int worst_channel = 0;
    int pixels = 0;  ///< that differ by more than the tolerance's channel
    int ids = 0;
};
Difference difference(const Drawn& expected, const Drawn& actual, int channel);
bool within(const Difference& found, const Tolerance& tolerance);

/// Another driver drew the golden: what is seen where, and how bright and coloured it is on the whole.
struct Structure {
    double silhouette = 0;       ///< intersection over union of the pixels that show anything
    double ids = 0;              ///< share of the pixels that show anything in both and the same glyph in both
    double mean_difference = 0;  ///< of colour channels, 0 to 255
};
Structure structure(const Drawn& expected, const Drawn& actual);
bool alike(const Structure& found);  ///< 0.99, 0.99 and 2

/// |actual - expected| of each channel, four times as bright.
encode::Picture differencePicture(const encode::Picture& expected, const encode::Picture& actual);
encode::Picture readPng(const std::filesystem::path& path);
/// Makes the folder if need be.
void writePng(const std::filesystem::path& path, const encode::Picture& picture);

}  // namespace radiata::test
