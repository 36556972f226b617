#include "render/light/lattice_key.h"

#include <cstdio>
#include <initializer_list>

#include "base/checked.h"
#include "shaders/shared/lattice.glsl"

namespace radiata::render {
namespace {

/// Numbers as short as they can be without losing a bit.
std::string words(std::initializer_list<double> numbers) {
    std::string text;
    for (const double number : numbers) {
        char word[32];
        std::snprintf(word, sizeof word, " %.17g", number);
        text += word;
    }
    return text;
}

std::string words(const glm::dvec3& v) { return words({v.x, v.y, v.z}); }

std::string lightKey(const model::Illumination& light, const model::EnvironmentMap* map, const glm::vec3& albedo) {
    std::string key;
    if (light.environment) {
        key += "; environment" + words({static_cast<double>(map != nullptr ? map->check : 0), light.environment->scale});
    } else {
        key += "; sky" + words(light.sky.radiance) + words(light.sky.gradient) + words(light.sky.up);
    }
    for (const model::SunDisc& sun : light.suns) {
        key += "; sun" + words(sun.direction) + words({sun.angular_radius_deg}) + words(sun.irradiance);
    }
    for (const model::SphereLight& lamp : light.lights) {
        key += "; lamp" + words(lamp.position_mm) + words({lamp.radius_mm}) + words(lamp.intensity);
    }
    const auto& turn = light.rotation;
    key += "; turned" + words({turn[0], turn[1], turn[2], turn[3]});
    if (light.storage == model::TexelStorage::kRgb8) key += "; albedo" + words(albedo);
    return key;
}

}  // namespace

double voxelsPerTexel(model::LatticeResolution resolution) {
    return resolution == model::LatticeResolution::kEighth ? 2 : resolution == model::LatticeResolution::kOne ? 1 : 0.5;
}

glm::ivec3 latticeSize(const glm::ivec3& samples, model::LatticeResolution resolution) {
    return glm::ivec3(glm::ceil(glm::dvec3(samples - 1) / voxelsPerTexel(resolution))) + 1;
}

std::uint64_t latticeProduct(const glm::ivec3& v) {
    return checkedMultiply(checkedMultiply(static_cast<std::uint64_t>(v.x), static_cast<std::uint64_t>(v.y), "lattice"),
                           static_cast<std::uint64_t>(v.z), "lattice");
}

std::uint64_t texelBytes(const model::Illumination& light) {
    const auto count = static_cast<std::uint64_t>(light.payloadCount());
    if (light.storage == model::TexelStorage::kRgb8) return 4;
    return light.storage == model::TexelStorage::kFloat32 ? 4 * count : 4 * ((count + 1) / 2);
}

std::string latticeKey(const store::VolumeDataset& volume, const model::Illumination& light, const model::EnvironmentMap* map,
                       const glm::vec3& albedo) {
    const shader::VolumeParams& grid = volume.params();
    std::string key = "lattice of volume " + std::to_string(volume.check()) + words(glm::dvec3(grid.size));
    for (const glm::vec3& axis : {grid.grid_x, grid.grid_y, grid.grid_z}) key += words(axis);
    // Lights in the scene and the directions of all others are in world axes.
    key += "; from" + words(volume.gridToWorld(glm::dvec3(0))) + "; texels" +
           words(glm::dvec3(latticeSize(grid.size, light.resolution)));
    const bool transfer = light.payload == model::TexelPayload::kTransfer;
    key += transfer ? "; transfer, orders" : "; irradiance";
    for (int k = 0; k <= light.bounces && transfer; ++k) key += words({double(light.orders[static_cast<std::size_t>(k)])});
    key += "; bounces" + words({double(light.bounces)});
    key += light.storage == model::TexelStorage::kRgb8      ? "; rgb8"
           : light.storage == model::TexelStorage::kFloat16 ? "; float16"
                                                            : "; float32";
    if (light.sampling == model::TexelSampling::kRandom) key += "; random paths";
    return transfer ? key : key + lightKey(light, map, albedo);
}

io::LatticeHeader latticeHeader(const store::VolumeDataset& volume, const model::Illumination& light,
                                const model::EnvironmentMap* map, const glm::vec3& albedo) {
    constexpr int kEdge = static_cast<int>(shader::TEXEL_BRICK_EDGE);
    const glm::ivec3 bricks = (latticeSize(volume.params().size, light.resolution) + (kEdge - 1)) / kEdge;
    return {latticeKey(volume, light, map, albedo), static_cast<std::uint32_t>(texelBytes(light)), latticeProduct(bricks)};
}

}  // namespace radiata::render
