// wyman-fig4 (shadows that fade as the isovalue moves), wyman-fig10 (vicinity shading by both payloads) and wyman-fig11 (both
// payloads beside path tracing). Source: Wyman et al. 2006, Sec. 3 and 5.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "build/folded_ball.h"
#include "reference/path_tracer.h"
#include "tools/lab/experiments.h"
#include "tools/lab/light_bench.h"

namespace radiata::lab {
namespace {

constexpr double kCordVanishes = 62;
const glm::dvec3 kSunDirection = glm::normalize(glm::dvec3(0, 0.5, 1));

/// A floor, and above it a cord that gets thinner as the isovalue grows and is gone beyond 62.
model::ScalarImage cordOverFloor() {
    model::ScalarImage image;
    image.size = glm::ivec3(48);
    image.source = "cord";
    image.voxel_to_world[3] = glm::dvec4(-23.5, -23.5, -23.5, 1);
    for (int z = 0; z < 48; ++z) {
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 48; ++x) {
                const double floor = 50 + 8.0 * (14 - z), cord = kCordVanishes - 8 * std::hypot(y - 28.0, z - 26.0);
                image.values.push_back(static_cast<float>(std::max(floor, cord)));
            }
        }
    }
    return image;
}

/// One minus what the middle of the shadow has of the light beside it. The middle lies between two pixels of a column and has
/// what a straight line between them has: pixels are further apart than a thin shadow is wide. Nothing if the picture shows no
/// such pixels, or none beside.
std::optional<double> shadowDepth(const model::Frame& frame) {
    struct Seen {
        double off, value;  // from where the ray towards the sun passes the cord's axis, voxels; light
    };
    const auto width = static_cast<std::size_t>(frame.pixels.width), height = frame.pixels.depth.size() / width;
    double in_shadow = 0, beside = 0;
    int crossings = 0, other_pixels = 0;
    for (std::size_t column = 0; column < width; ++column) {
        std::optional<Seen> above;
        for (std::size_t row = 0; row < height; ++row) {
            const std::size_t i = row * width + column;
            const std::optional<Seen> last = std::exchange(above, std::nullopt);
            if (!std::isfinite(frame.pixels.depth[i])) continue;
            const glm::dvec3 grid =
                23.5 + frame.info.position_origin_mm +
                glm::dvec3(frame.pixels.position[3 * i], frame.pixels.position[3 * i + 1], frame.pixels.position[3 * i + 2]);
            if (grid.z > 17 || std::abs(grid.x - 23.5) > 8) continue;
            const double v = frame.pixels.rgba[4 * i] / 255.0;
            above = {grid.y + (26 - grid.z) * kSunDirection.y / kSunDirection.z - 28,
                     v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4)};
            if (std::abs(above->off) > 7 && std::abs(above->off) < 12) {
                beside += above->value;
                ++other_pixels;
            }
            if (!last || (last->off < 0) == (above->off < 0)) continue;
            in_shadow += (last->value * above->off - above->value * last->off) / (above->off - last->off);
            ++crossings;
        }
    }
    if (crossings == 0 || other_pixels == 0) return std::nullopt;
    return 1 - in_shadow / crossings * other_pixels / beside;
}

/// Rounding of 8 bits is no shadow.
std::string depthText(const std::optional<double>& depth) {
    if (!depth) return "not seen";
    return percent(std::abs(*depth) < 1e-9 ? 0 : *depth);
}

/// The same by path tracing in double at points of the two places.
double trueDepth(const model::ScalarImage& image, double isovalue) {
    const reference::ScalarField field(image.size, std::vector<double>(image.values.begin(), image.values.end()));
    const reference::Lights lights{
        [](const glm::dvec3&) { return 0.2; }, {}, {{kSunDirection, std::cos(5 * std::numbers::pi / 180), 1.5}}};
    const double z = 14 - (isovalue - 50) / 8, middle = 28 - (26 - z) * kSunDirection.y / kSunDirection.z;
    std::vector<double> found(8);
    parallelFor(found.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::dvec3 p(20 + static_cast<double>(i % 4) * 2.3, middle + (i < 4 ? 0.0 : 9.0), z);
            const auto light = reference::irradianceByBounce(field, isovalue, p, lights, 1, 3000, 17 + i);
            found[i] = light.mean[0] + 0.7 * light.mean[1];
        }
    });
    return 1 - (found[0] + found[1] + found[2] + found[3]) / (found[4] + found[5] + found[6] + found[7]);
}

}  // namespace

Report wymanFig4(gpu::Device& device, const Options& options) {
    LightBench bench(device, options, "wyman-fig4", cordOverFloor(), 50,
                     "a floor and a cord above it that is gone at isovalue 62");
    bench.report.scene =
        "48^3 voxels: a floor and a cord above it that is gone beyond isovalue 62; sun of 5 degrees, sky of 0.2, one bounce";
    Table table{"depth of the cord's shadow on the floor by isovalue",
                {"isovalue", "cord's radius, voxels", "path tracing", "own level sets", "texels on the shown surface"},
                {}};
    double worst_own = 0, worst_rest = 0;
    for (const float isovalue : {46.0F, 50.0F, 54.0F, 58.0F, 60.0F, 61.5F, 63.0F, 66.0F, 70.0F}) {
        model::FrameRequest request = bench.request(LabSky::kSun);
        request.scene.layers[0].surface().isovalue = isovalue;
        request.camera.eye_mm = {0, -60, 120};
        request.camera.perspective = false;
        request.camera.height_mm = 44;
        model::Illumination& light = LightBench::lightOf(request);
        light.bounces = 1;
        light.sky.radiance = glm::vec3(0.2F);
        light.suns = {{kSunDirection, 5, glm::vec3(1.5F)}};
        light.samples_max = 128;
        const model::Outputs outputs{.depth = true, .position = true};
        const std::optional<double> rest = shadowDepth(bench.draw(request, outputs));
        light.project = false;
        const std::optional<double> own = shadowDepth(bench.draw(request, outputs));
        const double truth = trueDepth(bench.image(), static_cast<double>(isovalue));
        if (own) worst_own = std::max(worst_own, std::abs(*own - truth));
        if (rest) worst_rest = std::max(worst_rest, std::abs(*rest - truth));
        table.rows.push_back({shortNumber(isovalue), shortNumber(std::max(0.0, (kCordVanishes - isovalue) / 8)), percent(truth),
                              depthText(own), depthText(rest)});
    }
    bench.report.tables.push_back(table);
    if (LabVolume head = headOrBall(48); head.head) {
        LightBench cortex(device, options, "wyman-fig4", std::move(head.image), head.isovalue, head.name, 96);
        Table other{head.name + "; error under the sun of 5 degrees by isovalue",
                    {"isovalue", "own level sets", "texels on the shown surface"},
                    {}};
        for (const float isovalue : {50.0F, 60.0F, 70.0F}) {
            model::FrameRequest request = cortex.request(LabSky::kSun);
            request.scene.layers[0].surface().isovalue = isovalue;
            LightBench::lightOf(request).samples_max = 128;
            const LightTruth truth = lightTruth(cortex.renderer(), cortex.image(), request, kTruthPixels, 800);
            const double rest = lightError(cortex.draw(request), truth);
            LightBench::lightOf(request).project = false;
            other.rows.push_back({shortNumber(isovalue), percent(lightError(cortex.draw(request), truth)), percent(rest)});
        }
        bench.report.tables.push_back(other);
        bench.report.notes.push_back("the head is drawn with " + cortex.report.view);
        bench.noteErrors();
    }
    bench.report.notes.push_back("depth: one minus the light in the middle of the shadow over that beside it; 0 is no shadow");
    bench.report.notes.push_back(
        "texels between two voxels' isovalues mix shadows of cords of several radii: on their own level sets "
        "shadows fade, as the paper's Fig. 4 shows; texels on the shown surface know its own cord only");
    bench.report.checks.push_back({"largest error, shown surface / own level sets", worst_rest / worst_own, "<=", 0.65});
    return bench.report;
}

Report wymanFig10(gpu::Device& device, const Options& options) {
    LightBench bench(device, options, "wyman-fig10", foldedBall(64), 30, "folded ball of 64^3 voxels");
    bench.report.scene = "folded ball of 64^3 voxels under a constant sky, no bounces";
    bench.noteErrors();
    model::FrameRequest request = bench.request(LabSky::kEven);
    model::Illumination& light = LightBench::lightOf(request);
    light.bounces = 0;
    light.relative_error = 0.01F;
    light.project = false;
    const LightTruth truth = lightTruth(bench.renderer(), bench.image(), request, kTruthPixels, 2000);
    const model::Frame irradiance = bench.draw(request);
    light.payload = model::TexelPayload::kTransfer;
    light.orders = {1, 1, 1, 1, 1};
    const model::Frame transfer = bench.draw(request);
    int differ = 0, most = 0;
    for (std::size_t i = 0; i < irradiance.pixels.rgba.size(); ++i) {
        const int off = std::abs(irradiance.pixels.rgba[i] - transfer.pixels.rgba[i]);
        differ += off > 1;
        most = std::max(most, off);
    }
    Table table{"vicinity shading by both payloads", {"texels keep", "numbers", "error"}, {}};
    table.rows.push_back({"irradiance", "3", percent(lightError(irradiance, truth))});
    table.rows.push_back({"transfer, band 0 only", "1", percent(lightError(transfer, truth))});
    bench.report.tables.push_back(table);
    bench.report.notes.push_back("the two pictures differ by more than a 255th in " + std::to_string(differ) + " of " +
                                 std::to_string(irradiance.pixels.rgba.size()) + " numbers, by " + std::to_string(most) +
                                 " at most");
    bench.report.checks.push_back({"numbers that differ, share",
                                   static_cast<double>(differ) / static_cast<double>(irradiance.pixels.rgba.size()),
                                   "<=", 0.01});
    return bench.report;
}

Report wymanFig11(gpu::Device& device, const Options& options) {
    LabVolume volume = headOrBall(64);
    LightBench bench(device, options, "wyman-fig11", std::move(volume.image), volume.isovalue, volume.name);
    bench.noteErrors();
    Table table{
        "error against path tracing", {"sky", "texels keep", "own level sets", "texels on the shown surface", "ratio"}, {}};
    for (const LabSky sky : {LabSky::kEven, LabSky::kWideSun, LabSky::kSun}) {
        const LightTruth truth = bench.truth(sky);
        for (const bool transfer : {false, true}) {
            std::vector<std::string> row{lab::name(sky), transfer ? "transfer of order 5" : "irradiance"};
            double own = 0, shown = 0;
            for (const bool project : {false, true}) {
                model::FrameRequest request = bench.request(sky);
                model::Illumination& light = LightBench::lightOf(request);
                light.relative_error = 0.01F;
                light.project = project;
                if (transfer) light.payload = model::TexelPayload::kTransfer;
                if (transfer) light.orders = {5, 5, 5, 5, 5};
                double& error = project ? shown : own;
                error = lightError(bench.draw(request), truth);
                row.push_back(percent(error));
            }
            row.push_back(shortNumber(shown / own));
            table.rows.push_back(row);
        }
    }
    bench.report.tables.push_back(table);
    bench.report.notes.push_back("transfer blurs suns: five bands cannot tell them from a bright part of the sky");
    return bench.report;
}

}  // namespace radiata::lab
