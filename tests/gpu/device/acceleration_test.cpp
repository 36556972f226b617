// Ray-query structures over boxes are built cleanly and give their memory back.
#include "gpu/acceleration.h"

#include <random>
#include <vector>

#include "gpu/device/fixture.h"

namespace radiata::gpu {
namespace {

using BoxAccelerationTest = DeviceTest;

std::vector<Aabb> randomBoxes(std::size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> position(-50, 50);
    std::vector<Aabb> boxes(count);
    for (Aabb& box : boxes) {
        for (int axis = 0; axis < 3; ++axis) {
            box.min[axis] = position(random);
            box.max[axis] = box.min[axis] + 1;
        }
    }
    return boxes;
}

TEST_F(BoxAccelerationTest, BuildsOverOneBoxAndOverMany) {
    if (!device.has(Feature::kRayQuery)) {  // such a device must refuse, and say why
        EXPECT_EQ(errorOf([&] { BoxAcceleration(device, randomBoxes(1)); }).code(), Code::kUnsupported);
        return;
    }
    const std::uint64_t before = device.allocatedBytes();
    for (const std::size_t count : {1U, 20'000U}) {
        const BoxAcceleration acceleration(device, randomBoxes(count));
        EXPECT_TRUE(acceleration);
        EXPECT_NE(acceleration.address(), 0U);
        EXPECT_GE(acceleration.sizeBytes(), count * sizeof(Aabb));
        EXPECT_GE(device.allocatedBytes(), before + acceleration.sizeBytes());
    }
    EXPECT_EQ(device.allocatedBytes(), before);
}

TEST_F(BoxAccelerationTest, RefusesNoBoxes) {
    if (!device.has(Feature::kRayQuery)) return;
    EXPECT_EQ(errorOf([&] { BoxAcceleration(device, {}); }).code(), Code::kInvalidArgument);
}

TEST(BoxAcceleration, RefusesADeviceWhoseRayQueriesAreLeftOff) {
    Device device(DeviceOptions{.validation = true, .without = {"ray_query"}});
    EXPECT_FALSE(device.has(Feature::kRayQuery));
    EXPECT_EQ(errorOf([&] { BoxAcceleration(device, randomBoxes(1)); }).code(), Code::kUnsupported);
    EXPECT_TRUE(device.takeValidationMessages().empty());
}

}  // namespace
}  // namespace radiata::gpu
