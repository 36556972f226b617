// The choice of a device and of what is asked of it.
#include "gpu/device.h"

#include <algorithm>

#include "gpu/device/fixture.h"
#include "gpu/device_features.h"

namespace radiata::gpu {
namespace {

bool contains(const Error& error, const std::string& text) { return std::string(error.what()).find(text) != std::string::npos; }

TEST(Device, SaysWhatItIs) {
    const Device device(DeviceOptions{});
    const DeviceInfo& info = device.info();
    EXPECT_FALSE(info.name.empty());
    EXPECT_FALSE(info.driver.empty());
    EXPECT_GE(info.subgroup_size, 1U);
    EXPECT_GE(info.storage_range_max, 1U << 27);
    EXPECT_GT(info.memory_bytes, 0U);
    EXPECT_EQ(device.allocatedBytes(), 0U);
    EXPECT_TRUE(device.has(Feature::kSubgroupBallot));
}

TEST(Device, IsChosenByNumberAndByPartOfItsName) {
    const std::vector<std::string> names = Device::list();
    ASSERT_FALSE(names.empty());
    const std::string name = Device(DeviceOptions{}).info().name;
    const auto number = std::ranges::find(names, name) - names.begin();
    ASSERT_LT(number, static_cast<std::ptrdiff_t>(names.size()));
    EXPECT_EQ(Device(DeviceOptions{.device = std::to_string(number)}).info().name, name);
    EXPECT_EQ(Device(DeviceOptions{.device = name}).info().name, name);
    std::string part = name.substr(0, 4);
    std::ranges::transform(part, part.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    EXPECT_EQ(Device(DeviceOptions{.device = part}).info().name, name);
}

TEST(Device, UnknownOneIsAnErrorThatListsTheOthers) {
    for (const std::string wanted : {"warp core", "99", "-1", "0x0"}) {
        const Error error = errorOf([&] { Device(DeviceOptions{.device = wanted}); });
        EXPECT_EQ(error.code(), Code::kNotFound);
        EXPECT_TRUE(contains(error, "'" + wanted + "'")) << error.what();
        EXPECT_TRUE(contains(error, "0 '" + Device::list()[0] + "'")) << error.what();
    }
}

TEST(Device, UnknownFeatureIsAnErrorThatListsTheKnownOnes) {
    const Error error = errorOf([&] { Device(DeviceOptions{.without = {"ray_query", "teleport"}}); });
    EXPECT_EQ(error.code(), Code::kInvalidArgument);
    for (const char* name : {"'teleport'", "ray_query", "int64_atomics", "mesh_shader", "memory_budget"}) {
        EXPECT_TRUE(contains(error, name)) << error.what();
    }
}

TEST(Device, WhatEverythingNeedsCannotBeLeftOff) {
    const Error error = errorOf([&] { Device(DeviceOptions{.without = {"buffer_device_address"}}); });
    EXPECT_EQ(error.code(), Code::kInvalidArgument);
}

TEST(Device, OptionalFeaturesCanBeLeftOffOneByOneAndAllAtOnce) {
    std::vector<std::string> all;
    for (const FeatureRow& row : featureTable()) {
        if (row.fallback == nullptr) continue;
        ASSERT_TRUE(row.feature) << row.name << ": code must be able to ask for what may be missing";
        Device device(DeviceOptions{.validation = true, .without = {row.name}});
        EXPECT_FALSE(device.has(*row.feature)) << row.name;
        EXPECT_TRUE(device.takeValidationMessages().empty()) << row.name;
        all.emplace_back(row.name);
    }
    Device device(DeviceOptions{.validation = true, .without = all});
    for (const FeatureRow& row : featureTable()) {
        if (!row.feature) continue;
        EXPECT_EQ(device.has(*row.feature), row.fallback == nullptr) << row.name;
    }
    EXPECT_TRUE(device.takeValidationMessages().empty());
}

TEST(Device, FeatureTableIsComplete) {
    std::vector<std::string> names;
    for (const FeatureRow& row : featureTable()) {
        EXPECT_FALSE(std::string(row.needed_by).empty()) << row.name;
        EXPECT_EQ(std::ranges::count(names, row.name), 0) << row.name;
        names.emplace_back(row.name);
    }
    for (int i = 0; i < 5; ++i) {
        const auto feature = static_cast<Feature>(i);
        EXPECT_EQ(std::ranges::count_if(featureTable(), [&](const FeatureRow& row) { return row.feature == feature; }), 1) << i;
    }
}

}  // namespace
}  // namespace radiata::gpu
