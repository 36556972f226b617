#include "render/light/path_light.h"

#include <algorithm>

#include "render/light/transport_params.h"

namespace radiata::render {
namespace {

constexpr std::size_t kKept = 4;

/// Light as its estimates depend on it; texels are none, so neither are their payload and bands.
model::Illumination transported(model::Illumination light) {
    const model::Illumination usual;
    light.payload = usual.payload;
    light.storage = usual.storage;
    light.interpolation = usual.interpolation;
    light.resolution = usual.resolution;
    light.orders = usual.orders;
    light.project = usual.project;
    light.relative_error = usual.relative_error;
    light.samples_max = usual.samples_max;
    light.budget_mib = usual.budget_mib;
    return light;
}

}  // namespace

PathLight::PathLight(gpu::Device& device, std::shared_ptr<const store::VolumeDataset> volume, const model::Illumination& light,
                     std::shared_ptr<const model::EnvironmentMap> map, const glm::vec3& albedo)
    : volume_(std::move(volume)),
      light_(transported(light)),
      map_(std::move(map)),
      albedo_(albedo),
      buffers_(device, light_, map_.get(), *volume_),
      params_(device, sizeof(shader::LatticeParams), gpu::Memory::kUpload, "path-traced light") {
    shader::LatticeParams params = transportParams(*volume_, light_);
    params.albedo = albedo;
    params.light = buffers_.params();
    params.irradiance_floor = std::max(0.01F * buffers_.openIrradiance(), 1e-20F);
    params_.as<shader::LatticeParams>()[0] = params;
}

bool PathLight::serves(const store::VolumeDataset* volume, const model::Illumination& light, const model::EnvironmentMap* map,
                       const glm::vec3& albedo) const {
    return volume == volume_.get() && map == map_.get() && albedo == albedo_ && transported(light) == light_;
}

std::shared_ptr<const PathLight> PathLights::get(gpu::Device& device, const std::shared_ptr<const store::VolumeDataset>& volume,
                                                 const model::Illumination& light,
                                                 const std::shared_ptr<const model::EnvironmentMap>& map,
                                                 const glm::vec3& albedo) {
    const auto found =
        std::ranges::find_if(kept_, [&](const auto& one) { return one->serves(volume.get(), light, map.get(), albedo); });
    if (found != kept_.end()) return *found;
    kept_.push_front(std::make_shared<PathLight>(device, volume, light, map, albedo));
    if (kept_.size() > kKept) kept_.pop_back();
    return kept_.front();
}

}  // namespace radiata::render
