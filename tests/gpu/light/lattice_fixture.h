// A lattice on the device without a picture: all its texels, or what made surfaces need.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "gpu/device.h"
#include "render/light/lattice.h"
#include "shaders/modules.h"

namespace radiata::test {

class LatticeTest : public ::testing::Test {
protected:
    static void SetUpTestSuite() { device_ = std::make_unique<gpu::Device>(gpu::DeviceOptions{.validation = true}); }
    static void TearDownTestSuite() {
        pipelines_.clear();
        device_.reset();
    }
    void TearDown() override {
        for (const std::string& message : device_->takeValidationMessages()) ADD_FAILURE() << message;
    }

    gpu::Device& device() { return *device_; }
    render::LatticeRun run() {
        if (!recorder_) recorder_ = std::make_unique<gpu::CommandRecorder>(*device_);
        return {*device_, *recorder_,
                [](const std::string& shader, const std::vector<std::uint32_t>& constants) -> const gpu::ComputePipeline& {
                    gpu::ComputePipeline& made = pipelines_[{shader, constants}];
                    if (!made) {
                        const shaders::Module& module = shaders::module(shader);
                        made = gpu::ComputePipeline(*device_, {module.name, module.spirv}, constants);
                    }
                    return made;
                },
                nullptr};
    }

    /// A volume of 1 mm voxels from a function of grid coordinates.
    template <typename F>
    model::ScalarImage image(glm::ivec3 size, const F& function) const {
        model::ScalarImage result;
        result.size = size;
        result.source = "made";
        for (int z = 0; z < size.z; ++z) {
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x) result.values.push_back(static_cast<float>(function(glm::dvec3(x, y, z))));
            }
        }
        return result;
    }
    std::shared_ptr<const store::VolumeDataset> volume(const model::ScalarImage& image) {
        return std::make_shared<store::VolumeDataset>(*device_, image);
    }

    /// All texels of a lattice, lit to the end.
    std::unique_ptr<render::IlluminationLattice> full(const std::shared_ptr<const store::VolumeDataset>& data,
                                                      const model::Illumination& light, float albedo = 0.7F) {
        auto lattice = std::make_unique<render::IlluminationLattice>(*device_, data, light, false);
        lattice->update(run(), light, nullptr, glm::vec3(albedo), 0);
        lattice->requestAll(run());
        lattice->refine(run(), {});
        return lattice;
    }

private:
    static inline std::unique_ptr<gpu::Device> device_;
    static inline std::map<std::pair<std::string, std::vector<std::uint32_t>>, gpu::ComputePipeline> pipelines_;
    std::unique_ptr<gpu::CommandRecorder> recorder_;
};

}  // namespace radiata::test
