// Runs a shader function over an array on the device, to hold it against its double-precision twin.
// The shader side is shaders/test/function.glsl.
//
//   std::vector<Out> results = runFunction<Out>("test_shading", {}, inputs);
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/pipeline.h"
#include "gpu/recorder.h"
#include "shaders/modules.h"

namespace radiata::test {

class FunctionTest : public ::testing::Test {
protected:
    /// One device for all tests of a suite; making one takes longer than most of them.
    static void SetUpTestSuite() { device_ = std::make_unique<gpu::Device>(gpu::DeviceOptions{.validation = true}); }
    static void TearDownTestSuite() {
        pipelines_.clear();
        device_.reset();
    }
    void TearDown() override {
        for (const std::string& message : device_->takeValidationMessages()) ADD_FAILURE() << message;
    }

    /// \param constants      specialisation constants of the wrapper, from id 1
    /// \param shared_values  what every call may read
    /// \return  function(input) for each input, in order
    template <typename Output, typename Input>
    std::vector<Output> runFunction(std::string_view module_name, const std::vector<std::uint32_t>& constants,
                                    const std::vector<Input>& inputs, const std::vector<float>& shared_values = {0}) {
        std::vector<Output> outputs(inputs.size());
        run(module_name, constants, inputs.size(), std::as_bytes(std::span(inputs)), shared_values,
            std::as_writable_bytes(std::span(outputs)));
        return outputs;
    }

    /// The same for outputs of `width` floats, one after the other.
    template <typename Input>
    std::vector<float> runFunctionToFloats(std::string_view module_name, const std::vector<std::uint32_t>& constants,
                                           const std::vector<Input>& inputs, std::size_t width,
                                           const std::vector<float>& shared_values = {0}) {
        std::vector<float> outputs(inputs.size() * width);
        run(module_name, constants, inputs.size(), std::as_bytes(std::span(inputs)), shared_values,
            std::as_writable_bytes(std::span(outputs)));
        return outputs;
    }

    gpu::Device& device() { return *device_; }

    /// Device time of the last run.
    double time_ms_ = 0;

private:
    static constexpr std::uint32_t kGroupSize = 64;
    struct Push {
        std::uint64_t inputs, outputs, shared_values;
        std::uint32_t count, padding = 0;
    };

    void run(std::string_view module_name, const std::vector<std::uint32_t>& constants, std::size_t size,
             std::span<const std::byte> inputs, const std::vector<float>& shared_values, std::span<std::byte> outputs) {
        const gpu::ComputePipeline& function = pipeline(module_name, constants);
        const gpu::Buffer input_buffer = uploaded(inputs, "inputs");
        const gpu::Buffer shared_buffer = uploaded(std::as_bytes(std::span(shared_values)), "shared values");
        const gpu::Buffer output_buffer(*device_, outputs.size(), gpu::Memory::kDevice, "outputs");
        const auto count = static_cast<std::uint32_t>(size);
        gpu::CommandRecorder recorder(*device_);
        recorder.dispatch(function, "function", (count + kGroupSize - 1) / kGroupSize, 1, 1,
                          Push{input_buffer.address(), output_buffer.address(), shared_buffer.address(), count});
        recorder.submitAndWait();
        time_ms_ = recorder.takeTimings().at(0).time_ms;
        gpu::download(*device_, output_buffer, 0, outputs);
    }

    using PipelineKey = std::pair<std::string, std::vector<std::uint32_t>>;

    /// Compiled once per suite: large functions take seconds.
    static const gpu::ComputePipeline& pipeline(std::string_view module_name, const std::vector<std::uint32_t>& constants) {
        gpu::ComputePipeline& pipeline = pipelines_[{std::string(module_name), constants}];
        if (!pipeline) {
            std::vector<std::uint32_t> all_constants{kGroupSize};
            all_constants.insert(all_constants.end(), constants.begin(), constants.end());
            const shaders::Module& module = shaders::module(module_name);
            pipeline = gpu::ComputePipeline(*device_, {module.name, module.spirv}, all_constants);
        }
        return pipeline;
    }

    static gpu::Buffer uploaded(std::span<const std::byte> bytes, const std::string& name) {
        gpu::Buffer buffer(*device_, bytes.size(), gpu::Memory::kDevice, name);
        gpu::upload(*device_, buffer, 0, bytes);
        return buffer;
    }

    static inline std::unique_ptr<gpu::Device> device_;
    static inline std::map<PipelineKey, gpu::ComputePipeline> pipelines_;
};

}  // namespace radiata::test
