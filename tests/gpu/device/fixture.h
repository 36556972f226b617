// A device with validation for each test; any message of the layers fails the test that caused it.
#pragma once

#include <gtest/gtest.h>

#include "base/error.h"
#include "gpu/device.h"
#include "gpu/pipeline.h"
#include "shaders/modules.h"

namespace radiata::gpu {

class DeviceTest : public ::testing::Test {
protected:
    void TearDown() override {
        for (const std::string& message : device.takeValidationMessages()) ADD_FAILURE() << message;
    }

public:
    static ComputePipeline squarePipeline(Device& device, std::uint32_t group_size) {
        const shaders::Module& module = shaders::module("test_square");
        return {device, Shader{module.name, module.spirv}, std::span(&group_size, 1)};
    }

protected:
    Device device{DeviceOptions{.validation = true}};
};

/// Push constants of shaders/test/square.comp.
struct SquarePush {
    std::uint64_t numbers;
    std::uint32_t count;
    std::uint32_t padding = 0;
};

/// Runs and returns the Error that must come.
template <typename Body>
Error errorOf(Body&& body) {
    try {
        body();
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "no Error was thrown";
    return {Code::kInternal, ""};
}

}  // namespace radiata::gpu
