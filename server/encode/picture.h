// Pixels as the encoders take and the decoders give them: sRGB, 4 bytes a pixel (RGBA), rows from the top, no padding.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace radiata::encode {

/// Largest picture that the decoders and encoders accept, pixels.
constexpr std::uint64_t kPixelsMax = std::uint64_t{1} << 26;

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
};

struct PictureView {
    int width = 0;
    int height = 0;
    std::span<const std::uint8_t> rgba;

    PictureView(int width_px, int height_px, std::span<const std::uint8_t> pixels)
        : width(width_px), height(height_px), rgba(pixels) {}
    PictureView(const Picture& picture) : PictureView(picture.width, picture.height, picture.rgba) {}  // NOLINT: a view
};

/// \throws Error(kInvalidArgument) unless both sides are at least 1, at most kPixelsMax in all, and the bytes fit them
void check(const PictureView& picture);

}  // namespace radiata::encode
