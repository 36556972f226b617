// Drawing triangles: which of them stays, what is cleared, which rows are touched, and what is refused.
#include "gpu/raster_target.h"

#include <array>
#include <cstring>
#include <vector>

#include "gpu/device/fixture.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/recorder.h"

namespace radiata::gpu {
namespace {

constexpr std::uint32_t kWidth = 40, kHeight = 24;

/// Rectangle of shaders/test/rectangles.vert.
struct Rectangle {
    float low[2], high[2];
    float depth;
    std::uint32_t word;
};

struct Push {
    std::uint64_t rectangles;
};

class RasterTest : public DeviceTest {
protected:
    GraphicsPipeline pipeline(Faces faces) {
        const shaders::Module& vertex = shaders::module("test_rectangles_vert");
        const shaders::Module& fragment = shaders::module("test_rectangles_frag");
        const std::uint32_t constant = 77;
        const std::array stages{StageShader{ShaderStage::kVertex, {vertex.name, vertex.spirv}},
                                StageShader{ShaderStage::kFragment, {fragment.name, fragment.spirv}}};
        return {device, stages, std::span(&constant, 1), {.faces = faces}};
    }
    template <typename T>
    Buffer uploaded(const std::vector<T>& values) {
        Buffer buffer(device, values.size() * sizeof(T), Memory::kDevice, "values");
        upload(device, buffer, 0, std::as_bytes(std::span(values)));
        return buffer;
    }
    /// Reads both images: 4 words and a depth per pixel.
    void read(CommandRecorder& recorder, RasterTarget& target) {
        const Buffer word_buffer(device, kWidth * kHeight * 16, Memory::kReadback, "words");
        const Buffer depth_buffer(device, kWidth * kHeight * 4, Memory::kReadback, "depth");
        recorder.copy(target, word_buffer, depth_buffer);
        recorder.submitAndWait();
        words.assign(word_buffer.as<std::uint32_t>().begin(), word_buffer.as<std::uint32_t>().end());
        depth.assign(depth_buffer.as<float>().begin(), depth_buffer.as<float>().end());
    }
    std::uint32_t wordAt(std::uint32_t x, std::uint32_t y) const { return words[4 * (y * kWidth + x)]; }

    /// Two triangles that run clockwise as seen, with y downwards.
    const std::vector<std::uint32_t> kCorners{0, 1, 2, 2, 1, 3};
    std::vector<std::uint32_t> words;
    std::vector<float> depth;
};

TEST_F(RasterTest, KeepsTheGreaterDepthAndTheFirstOfEqualOnes) {
    const Buffer indices = uploaded(kCorners);
    // All of the picture at 0.25; the left half nearer; once more the left half at the same depth; the right half behind.
    const Buffer rectangles = uploaded<Rectangle>(
        {{{-1, -1}, {1, 1}, 0.25F, 1}, {{-1, -1}, {0, 1}, 0.5F, 2}, {{-1, -1}, {0, 1}, 0.5F, 3}, {{0, -1}, {1, 1}, 0.125F, 4}});
    RasterTarget target(device, kWidth, kHeight);
    const GraphicsPipeline all = pipeline(Faces::kAll);
    CommandRecorder recorder(device);
    for (int round = 0; round < 2; ++round) {
        recorder.clear(target);
        // In one draw, then in one draw per rectangle: the order of instances counts across draws too.
        for (std::uint32_t first = 0; first < 4; first += round == 0 ? 4 : 1) {
            recorder.draw(all, "rectangles", target, DrawRange{&indices, 6, first, round == 0 ? 4U : 1U, 0, kHeight},
                          Push{rectangles.address()});
        }
        read(recorder, target);
        for (std::uint32_t y = 0; y < kHeight; ++y) {
            for (std::uint32_t x = 0; x < kWidth; ++x) {
                const std::size_t at = y * kWidth + x;
                ASSERT_EQ(wordAt(x, y), x < kWidth / 2 ? 2U : 1U) << x << ' ' << y;
                ASSERT_EQ(depth[at], x < kWidth / 2 ? 0.5F : 0.25F);
                ASSERT_EQ(words[4 * at + 1], x);
                ASSERT_EQ(words[4 * at + 2], y);
                ASSERT_EQ(words[4 * at + 3], 77U);
            }
        }
        const std::vector<PassTiming> timings = recorder.takeTimings();
        ASSERT_EQ(timings.size(), 1U);
        EXPECT_EQ(timings[0].shader, "test_rectangles_frag");
        EXPECT_GT(timings[0].time_ms, 0);
    }
}

TEST_F(RasterTest, DrawsTheNamedRowsOnlyAndClearsTheRest) {
    const Buffer indices = uploaded(kCorners);
    const Buffer rectangles = uploaded<Rectangle>({{{-1, -1}, {1, 1}, 0.25F, 1}});
    RasterTarget target(device, kWidth, kHeight);
    const GraphicsPipeline all = pipeline(Faces::kAll);
    CommandRecorder recorder(device);
    for (const std::uint32_t first : {3U, 10U}) {
        recorder.clear(target);
        recorder.draw(all, "rows", target, DrawRange{&indices, 6, 0, 1, first, 5}, Push{rectangles.address()});
        read(recorder, target);
        for (std::uint32_t y = 0; y < kHeight; ++y) {
            const bool drawn = y >= first && y < first + 5;
            for (std::uint32_t x = 0; x < kWidth; ++x) {
                ASSERT_EQ(wordAt(x, y), drawn ? 1U : 0U) << y;
                ASSERT_EQ(depth[y * kWidth + x], drawn ? 0.25F : 0.0F);
            }
        }
    }
}

TEST_F(RasterTest, ShowsTheBacksOfFacesWhereAskedTo) {
    const Buffer away = uploaded(kCorners);
    const Buffer towards = uploaded<std::uint32_t>({0, 2, 1, 2, 3, 1});
    const Buffer rectangles = uploaded<Rectangle>({{{-1, -1}, {1, 1}, 0.25F, 1}});
    RasterTarget target(device, kWidth, kHeight);
    const GraphicsPipeline back = pipeline(Faces::kBack);
    CommandRecorder recorder(device);
    for (const Buffer* corners : {&away, &towards}) {
        recorder.clear(target);
        recorder.draw(back, "backs", target, DrawRange{corners, 6, 0, 1, 0, kHeight}, Push{rectangles.address()});
        read(recorder, target);
        EXPECT_EQ(wordAt(5, 5), corners == &away ? 1U : 0U);
    }
}

TEST_F(RasterTest, RefusesWhatCannotBeDrawn) {
    EXPECT_EQ(errorOf([&] { RasterTarget(device, 1'000'000, 8); }).code(), Code::kResourceExhausted);
    EXPECT_EQ(errorOf([&] { RasterTarget(device, 0, 8); }).code(), Code::kResourceExhausted);
    RasterTarget target(device, kWidth, kHeight);
    const Buffer small(device, 64, Memory::kDevice, "small");
    CommandRecorder recorder(device);
    EXPECT_EQ(errorOf([&] { recorder.copy(target, small, small); }).code(), Code::kInternal) << "never cleared";
    const GraphicsPipeline all = pipeline(Faces::kAll);
    EXPECT_EQ(errorOf([&] {
                  recorder.draw(all, "too early", target, DrawRange{&small, 6, 0, 1, 0, kHeight}, Push{small.address()});
              }).code(),
              Code::kInternal);
    recorder.clear(target);
    EXPECT_EQ(errorOf([&] { recorder.copy(target, small, small); }).code(), Code::kInternal) << "too small";
    EXPECT_EQ(errorOf([&] {
                  recorder.draw(all, "indices", target, DrawRange{&small, 600, 0, 1, 0, kHeight}, Push{small.address()});
              }).code(),
              Code::kInternal);
    recorder.discard();
}

TEST(Raster, IsLeftOffByName) {
    Device device{DeviceOptions{.validation = true, .without = {"raster"}}};
    EXPECT_FALSE(device.has(Feature::kRaster));
    EXPECT_EQ(errorOf([&] { RasterTarget(device, 8, 8); }).code(), Code::kUnsupported);
    for (const std::string& message : device.takeValidationMessages()) ADD_FAILURE() << message;
}

TEST_F(RasterTest, CountsTheMemoryOfItsImages) {
    const std::uint64_t before = device.allocatedBytes();
    {
        const RasterTarget target(device, 640, 480);
        EXPECT_GE(device.allocatedBytes() - before, 640U * 480 * 20);
    }
    EXPECT_EQ(device.allocatedBytes(), before);
}

}  // namespace
}  // namespace radiata::gpu
