// wyman-fig9: one view of a surface under each shading: its time, and how much of what path tracing shows it tells.
// Source: Wyman et al. 2006, Fig. 8 and 9, Sec. 5.
#include <cmath>

#include "tools/lab/experiments.h"
#include "tools/lab/light_bench.h"

namespace radiata::lab {
namespace {

/// Pearson's correlation of two pictures' green, where the surface is shown.
double likeness(const model::Frame& a, const model::Frame& b, const std::vector<float>& depth) {
    double n = 0, sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
        if (!std::isfinite(depth[i])) continue;
        const double x = a.pixels.rgba[4 * i + 1], y = b.pixels.rgba[4 * i + 1];
        ++n;
        sum_a += x;
        sum_b += y;
        aa += x * x;
        bb += y * y;
        ab += x * y;
    }
    return (ab - sum_a * sum_b / n) / std::sqrt((aa - sum_a * sum_a / n) * (bb - sum_b * sum_b / n));
}

}  // namespace

Report wymanFig9(gpu::Device& device, const Options& options) {
    ReadyFrames bench(device, options, "wyman-fig9",
                      "folded ball of 96^3 voxels under a sky and a sun of 18 degrees, texels ready");
    Report& report = bench.report;
    const model::FrameRequest full = bench.lit(0.05F, 256);
    model::FrameRequest vicinity = full;
    vicinity.scene.light.illumination->suns.clear();
    vicinity.scene.light.illumination->sky.radiance = glm::vec3(1);
    vicinity.scene.light.illumination->bounces = 0;
    model::FrameRequest lambert = ReadyFrames::local(full);
    lambert.scene.light.irradiance = 1.2F;
    lambert.scene.light.ambient = 0.3F;
    model::IsosurfaceLayer& surface = lambert.scene.layers[0].surface();
    surface.shading = model::SurfaceShading::kLambert;
    model::FrameRequest fog = lambert;
    fog.scene.layers[0].surface().fog = 0.9F;
    model::FrameRequest phong = lambert;
    phong.scene.layers[0].surface().shading = model::SurfaceShading::kPhong;
    const std::vector<Candidate> candidates{{"full (irradiance)", "", full},
                                            {"vicinity", "", vicinity},
                                            {"Lambert with fog", "", fog},
                                            {"Phong, varying ambient", "", phong},
                                            {"Phong, hard shadows", "", ReadyFrames::shadowed(phong)},
                                            {"Lambert, varying ambient", "", lambert},
                                            {"Lambert, hard shadows", "", ReadyFrames::shadowed(lambert)}};
    const std::vector<Measured> measured = bench.measureAll(candidates);
    model::FrameRequest traced = full;
    traced.scene.light.illumination->method = model::IlluminationMethod::kPathTracing;
    traced.scene.light.illumination->relative_error = 0.05F;
    const model::Frame truth = bench.draw(traced, {.depth = true});
    Table table{"shadings of one view", {"shading", "ms", "of Lambert", "correlation with path tracing"}, {}};
    const double base = measured[5].time.median();
    std::vector<double> alike;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const Measured& method = measured[i];
        alike.push_back(likeness(bench.draw(candidates[i].request), truth, truth.pixels.depth));
        table.rows.push_back({method.name, shortNumber(method.time.median()), shortNumber(method.time.median() / base),
                              shortNumber(alike.back())});
    }
    table.rows.push_back({"path tracing, " + shortNumber(100 * truth.info.illumination->mean_error) + " % standard error",
                          shortNumber(truth.info.render_ms), shortNumber(truth.info.render_ms / base), "1"});
    report.tables.push_back(table);
    report.checks.push_back(
        {"full / Phong with hard shadows, time", measured[0].time.median() / measured[4].time.median(), "<=", 1});
    report.checks.push_back({"correlation of full light with path tracing", alike[0], ">=", 0.97});
    report.checks.push_back({"correlation of full light less that of Phong", alike[0] - alike[3], ">=", 0.1});
    report.notes.push_back(
        "times are those of all passes on the device, of path tracing the whole picture; local shadings have the sun's "
        "direction and "
        "strength and the sky as ambient light, vicinity an even sky of 1");
    return std::move(report);
}

}  // namespace radiata::lab
