// wyman-fig5: normals of the trilinear cell and of the smoothing spline, on a ball whose true normals are known, with noise as
// 8-bit scans have it. Source: Wyman et al. 2006, Fig. 5 and Sec. 4.1.1.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "store/store.h"
#include "tools/lab/experiments.h"
#include "tools/lab/isosurface_scenes.h"
#include "tools/lab/measure.h"
#include "tools/lab/statistics.h"

namespace radiata::lab {
namespace {

constexpr int kSize = 96;

/// Falls by `step` per voxel from the middle, rounded to whole numbers and with noise of so many.
model::ScalarImage ball(double step, double noise) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    model::ScalarImage image;
    image.size = glm::ivec3(kSize);
    image.source = "ball";
    const double middle = 0.5 * (kSize - 1);
    for (int k = 0; k < kSize; ++k) {
        for (int j = 0; j < kSize; ++j) {
            for (int i = 0; i < kSize; ++i) {
                const double value =
                    128 + step * (0.35 * kSize - glm::length(glm::dvec3(i, j, k) - middle)) + noise * normal(random);
                image.values.push_back(static_cast<float>(std::clamp(std::round(value), 0.0, 255.0)));
            }
        }
    }
    return image;
}

struct Errors {
    std::vector<double> degrees;
};

Errors normalErrors(const Measured& method, const model::FrameRequest& request, const glm::dvec3& origin,
                    const model::Frame& frame) {
    Errors errors;
    for (std::size_t i = 0; i < frame.pixels.depth.size(); ++i) {
        if (!std::isfinite(frame.pixels.depth[i])) continue;
        const glm::dvec3 p = origin + glm::dvec3(frame.pixels.position[3 * i], frame.pixels.position[3 * i + 1],
                                                 frame.pixels.position[3 * i + 2]);
        const glm::dvec3 n(method.normal[3 * i], method.normal[3 * i + 1], method.normal[3 * i + 2]);
        const double cosine = glm::dot(n, glm::normalize(p - request.camera.target_mm));
        errors.degrees.push_back(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi);
    }
    return errors;
}

}  // namespace

Report wymanFig5(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "wyman-fig5";
    report.repeats = options.rounds();
    report.scene = "balls of 96^3 voxels of 8 bits";
    store::Store store(device, {});
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    const int height = options.size > 0 ? options.size : 512;
    report.view = std::to_string(height) + "x" + std::to_string(height) + ", perspective, one sample per pixel";
    Table table{"angle to the true normal, degrees", {"volume", "normals", "median", "95 %", "99 %", "ms"}, {}};
    double worst_ratio = 1e9;
    for (const auto& [name, step, noise] : {std::tuple{"steep, rounded", 8.0, 0.0}, std::tuple{"flat, rounded", 1.0, 0.0},
                                            std::tuple{"steep, noise of 4", 8.0, 4.0}}) {
        const model::ScalarImage image = ball(step, noise);
        store.add(std::string("ball") + std::to_string(report.series.size()), image);
        std::vector<Candidate> candidates;
        for (const auto& [normals, kind] :
             {std::pair{"trilinear", model::SurfaceNormals::kTrilinear}, std::pair{"spline", model::SurfaceNormals::kSpline}}) {
            model::FrameRequest request =
                surfaceRequest(image, std::string("ball") + std::to_string(report.series.size()), 127.5F, height, {2, -3, 1.5});
            request.quality.isosurface.normals = kind;
            candidates.push_back({normals, name, request});
        }
        const std::vector<Measured> measured = measure(renderer, candidates, report.repeats, {"isosurface"});
        const model::Frame frame = renderer.renderAll(candidates[0].request, {.depth = true, .position = true});
        std::vector<double> p95;
        for (const Measured& method : measured) {
            const Errors errors = normalErrors(method, candidates[0].request, frame.info.position_origin_mm, frame);
            p95.push_back(quantile(errors.degrees, 0.95));
            table.rows.push_back({name, method.name, shortNumber(median(errors.degrees)), shortNumber(p95.back()),
                                  shortNumber(quantile(errors.degrees, 0.99)), shortNumber(method.time.median())});
            Series series = method.time;
            series.name = std::string(name) + ", " + method.name;
            report.series.push_back(series);
        }
        worst_ratio = std::min(worst_ratio, p95[0] / p95[1]);
    }
    report.tables.push_back(table);
    report.checks.push_back({"95 % error, trilinear / spline, worst volume", worst_ratio, ">=", 1.5});
    report.notes.push_back(
        "the true normal points away from the middle; with noise the surface itself is rough, and the trilinear normal is its "
        "own");
    noteShortfalls(report, height, 512);
    return report;
}

}  // namespace radiata::lab
