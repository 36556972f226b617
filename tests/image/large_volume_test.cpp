// Volumes that take more than a range of a storage buffer may have: shaders read them by address.
#include <algorithm>
#include <cmath>

#include "image/fixture.h"
#include "store/volume_dataset.h"

namespace radiata::test {
namespace {

using LargeVolume = ImageTest;

TEST_F(LargeVolume, IsWholeBeyondTheRangeOfAStorageBuffer) {
    // 36 million samples, 143 MB as floats: the last slices lie beyond 128 MiB. Each slice has its number as its value.
    model::ScalarImage image;
    image.size = {512, 512, 136};
    image.source = "slices";
    constexpr std::ptrdiff_t kSlice = std::ptrdiff_t{512} * 512;
    image.values.resize(136 * kSlice);
    for (int z = 0; z < 136; ++z) std::fill_n(image.values.begin() + z * kSlice, kSlice, static_cast<float>(z));
    store.add("slices", std::move(image));
    ASSERT_GT(store.volume("slices")->gpuBytes(), std::uint64_t{128} << 20);
    for (const float isovalue : {2.25F, 133.75F}) {
        model::FrameRequest request;
        request.width = 16;
        request.height = 12;
        request.quality.samples = 1;
        request.scene.layers.emplace_back().content = model::IsosurfaceLayer{.dataset_id = "slices", .isovalue = isovalue};
        request.camera.target_mm = {256, 256, 68};
        request.camera.eye_mm = {290, 320, 400};
        request.camera.up = {0, 1, 0};
        request.camera.perspective = false;
        request.camera.height_mm = 100;
        const model::Frame frame = draw(request);
        for (std::size_t i = 0; i < 16 * 12; ++i) {
            ASSERT_EQ(frame.pixels.id[4 * i], 0);
            EXPECT_NEAR(frame.info.position_origin_mm.z + static_cast<double>(frame.pixels.position[3 * i + 2]), isovalue,
                        1e-3);
            EXPECT_NEAR(std::abs(frame.pixels.normal[3 * i + 2]), 1, 1e-4);
        }
    }
}

}  // namespace
}  // namespace radiata::test
