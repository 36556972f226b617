#include "tools/lab/light_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "reference/path_tracer.h"
#include "tools/lab/isosurface_scenes.h"

namespace radiata::lab {
namespace {

constexpr double kAlbedo = 0.7;
/// Of the march, voxels: what is between two steps is found by a parabola.
constexpr double kStep = 0.25;
const glm::dvec3 kSun = glm::normalize(glm::dvec3(0.7, -0.6, 0.6));

double sunDegrees(LabSky sky) { return sky == LabSky::kWideSun ? 18 : 5; }

reference::Lights lightsOf(LabSky sky) {
    if (sky == LabSky::kEven) return {[](const glm::dvec3&) { return 0.7; }, {}, {}};
    const double cosine = std::cos(sunDegrees(sky) * std::numbers::pi / 180);
    return {[](const glm::dvec3&) { return 0.3; }, {}, {{kSun, cosine, 1.2}}};
}

double linear(std::uint8_t value) {
    const double v = value / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

}  // namespace

std::string name(LabSky sky) {
    return sky == LabSky::kEven      ? "even sky"
           : sky == LabSky::kWideSun ? "sky and sun of 18 degrees"
                                     : "sky and sun of 5 degrees";
}

model::FrameRequest litRequest(const model::ScalarImage& image, const std::string& dataset, float isovalue, LabSky sky,
                               int size) {
    model::FrameRequest request = surfaceRequest(image, dataset, isovalue, size, {2, -3, 1.5});
    request.quality.samples = 1;
    request.scene.layers[0].surface().colour = glm::vec3(static_cast<float>(kAlbedo));
    model::Illumination& light = request.scene.light.illumination.emplace();
    light.sky.radiance = glm::vec3(sky == LabSky::kEven ? 0.7F : 0.3F);
    if (sky != LabSky::kEven) light.suns.push_back({kSun, static_cast<float>(sunDegrees(sky)), glm::vec3(1.2F)});
    return request;
}

LightTruth lightTruth(render::Renderer& renderer, const model::ScalarImage& image, const model::FrameRequest& request,
                      int count, int paths) {
    model::FrameRequest local = request;
    local.scene.light.illumination.reset();
    const model::Frame frame = renderer.renderAll(local, {.depth = true, .position = true});
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < frame.pixels.depth.size(); ++i) {
        if (std::isfinite(frame.pixels.depth[i])) shown.push_back(i);
    }
    LightTruth truth;
    const std::size_t step = std::max<std::size_t>(shown.size() / static_cast<std::size_t>(count), 1);
    for (std::size_t i = step / 2; i < shown.size(); i += step) truth.pixels.push_back(shown[i]);
    truth.radiance.resize(truth.pixels.size());
    truth.standard_error.resize(truth.pixels.size());
    const reference::ScalarField field(image);
    const glm::dmat4 to_grid = glm::inverse(image.voxel_to_world);
    const model::Illumination& light = *request.scene.light.illumination;
    const LabSky sky = light.suns.empty()                      ? LabSky::kEven
                       : light.suns[0].angular_radius_deg > 10 ? LabSky::kWideSun
                                                               : LabSky::kSun;
    const reference::Lights lights = lightsOf(sky);
    const double iso = *request.scene.layers[0].surface().isovalue;
    parallelFor(truth.pixels.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t at = 3 * truth.pixels[i];
            const glm::dvec3 world =
                frame.info.position_origin_mm +
                glm::dvec3(frame.pixels.position[at], frame.pixels.position[at + 1], frame.pixels.position[at + 2]);
            const auto found = reference::irradianceByBounce(field, iso, glm::dvec3(to_grid * glm::dvec4(world, 1)), lights,
                                                             light.bounces, paths, 100 + i, kStep);
            double weight = kAlbedo / std::numbers::pi, variance = 0;
            for (std::size_t k = 0; k < found.mean.size(); ++k, weight *= kAlbedo) {
                truth.radiance[i] += weight * found.mean[k];
                variance += std::pow(weight * found.standard_error[k], 2);
            }
            truth.standard_error[i] = std::sqrt(variance);
        }
    });
    for (const double radiance : truth.radiance) truth.mean += radiance / static_cast<double>(truth.radiance.size());
    return truth;
}

double lightError(const model::Frame& frame, const LightTruth& truth) {
    double squares = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const double off = linear(frame.pixels.rgba[4 * truth.pixels[i]]) - std::min(truth.radiance[i], 1.0);
        squares += off * off - truth.standard_error[i] * truth.standard_error[i];
    }
    return std::sqrt(std::max(squares / static_cast<double>(truth.pixels.size()), 0.0)) / truth.mean;
}

}  // namespace radiata::lab
