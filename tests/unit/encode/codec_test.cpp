// PNG keeps every byte; JPEG 4:4:4 at quality 95 keeps direction colours above 38 dB; broken bytes are refused in words.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"
#include "encode/jpeg.h"
#include "encode/png.h"

namespace radiata::encode {
namespace {

/// Smooth direction-like colours with fine stripes of hue, opaque.
Picture colours(int width, int height) {
    Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            picture.rgba.push_back(static_cast<std::uint8_t>(128 + 127 * std::sin(0.2 * x)));
            picture.rgba.push_back(static_cast<std::uint8_t>(128 + 127 * std::sin(0.2 * y + 1)));
            picture.rgba.push_back(static_cast<std::uint8_t>(128 + 127 * std::sin(0.15 * (x + y) + 2)));
            picture.rgba.push_back(255);
        }
    }
    return picture;
}

double psnr(const Picture& a, const Picture& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
        const double difference = static_cast<double>(a.rgba[i]) - b.rgba[i];
        if (i % 4 != 3) sum += difference * difference;
    }
    return 10 * std::log10(255.0 * 255.0 / (sum / (static_cast<double>(a.rgba.size()) * 0.75)));
}

template <typename Decode>
void refusesBrokenBytes(const std::vector<std::uint8_t>& good, Decode decode, bool truncation_is_an_error) {
    EXPECT_THROW(decode({}), Error);
    const std::vector<std::uint8_t> nonsense(100, 7);
    EXPECT_THROW(decode(nonsense), Error);
    for (const std::size_t size : {std::size_t{1}, std::size_t{10}, good.size() / 2}) {
        const std::span<const std::uint8_t> part(good.data(), size);
        if (truncation_is_an_error || size < 20) {
            EXPECT_THROW(decode(part), Error) << size;
        }
    }
    std::mt19937 random(7);
    for (int i = 0; i < 200; ++i) {
        std::vector<std::uint8_t> bytes = good;
        for (int k = 0; k < 8; ++k) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
        try {
            decode(bytes);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), Code::kCorrupt);
        }
    }
}

TEST(Png, KeepsEveryByte) {
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {161, 97}}) {
        const Picture picture = colours(width, height);
        const Picture back = decodePng(encodePng(picture));
        EXPECT_EQ(back.width, width);
        EXPECT_EQ(back.height, height);
        EXPECT_EQ(back.rgba, picture.rgba);
    }
}

TEST(Png, IsMarkedAsSrgbAndRepeatable) {
    const Picture picture = colours(40, 30);
    const auto bytes = encodePng(picture);
    const std::string chunk = "sRGB";
    EXPECT_NE(std::search(bytes.begin(), bytes.end(), chunk.begin(), chunk.end()), bytes.end());
    EXPECT_EQ(bytes, encodePng(picture));
}

TEST(Png, RefusesBrokenBytes) {
    refusesBrokenBytes(
        encodePng(colours(40, 30)), [](std::span<const std::uint8_t> bytes) { return decodePng(bytes); }, true);
}

TEST(Jpeg, KeepsDirectionColours) {
    const Picture picture = colours(160, 120);
    const Picture back = decodeJpeg(encodeJpeg(picture, 95));
    ASSERT_EQ(back.rgba.size(), picture.rgba.size());
    EXPECT_GT(psnr(picture, back), 38.0);
}

TEST(Jpeg, RefusesBrokenBytes) {
    refusesBrokenBytes(
        encodeJpeg(colours(40, 30), 90), [](std::span<const std::uint8_t> bytes) { return decodeJpeg(bytes); }, false);
}

TEST(Codecs, RefuseMalformedPictures) {
    Picture picture = colours(4, 4);
    EXPECT_THROW(encodeJpeg(picture, 0), Error);
    EXPECT_THROW(encodeJpeg(picture, 101), Error);
    picture.rgba.pop_back();
    EXPECT_THROW(encodeJpeg(picture, 90), Error);
    EXPECT_THROW(encodePng(picture), Error);
    EXPECT_THROW(encodePng(Picture{}), Error);
}

}  // namespace
}  // namespace radiata::encode
