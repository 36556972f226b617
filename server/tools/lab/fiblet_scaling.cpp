// fiblet-scaling: how the time of a frame grows with the tractogram, culled and not: fibres of a whole brain's extent, seen
// whole at 1280 x 720, in a turn of 1.14 degrees a frame (the protocol of Schertzer et al. 2022, Table 2). Culled frames follow
// each other in one view, so that each knows what the one before showed.
#include <algorithm>
#include <cmath>
#include <random>

#include "build/fiblet_encode.h"
#include "store/store.h"
#include "tools/lab/experiments.h"
#include "tools/lab/measure.h"
#include "tools/lab/statistics.h"

namespace radiata::lab {
namespace {

constexpr double kStepMm = 0.1, kDegreesPerFrame = 1.14;
constexpr std::size_t kPointsPerFibre = 800;
constexpr int kHeight = 720;

/// Fibres in a ball of brain size that turn a little at each step and are turned back at its surface: dense outside and inside.
model::FibletSet ballOfFibres(std::size_t fibres) {
    constexpr double kRadiusMm = 70;
    std::mt19937 random(31);
    std::normal_distribution<double> normal;
    std::vector<glm::vec3> points;
    std::vector<std::uint64_t> offsets{0};
    points.reserve(fibres * kPointsPerFibre);
    const auto direction = [&] { return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))); };
    for (std::size_t f = 0; f < fibres; ++f) {
        glm::dvec3 p = kRadiusMm * std::cbrt(0.999 * (static_cast<double>(random()) + 1) / 4294967297.0) * direction();
        glm::dvec3 d = direction();
        for (std::size_t i = 0; i < kPointsPerFibre; ++i) {
            points.emplace_back(p);
            const glm::dvec3 inward = glm::length(p) > kRadiusMm - 5 ? -0.05 * glm::normalize(p) : glm::dvec3(0);
            d = glm::normalize(d + 0.02 * direction() + inward);
            p += kStepMm * d;
        }
        offsets.push_back(points.size());
    }
    return encodeFiblets(points, offsets, {});
}

std::string label(std::size_t fibres, const char* what) { return std::to_string(fibres) + " fibres, " + what; }

}  // namespace

Report fibletScaling(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "fiblet-scaling";
    report.repeats = options.rounds();
    report.scene = "generated fibres of " + std::to_string(kPointsPerFibre) + " points, 0.1 mm apart, in a ball of 140 mm";
    store::Store store(device, {});
    const std::vector<std::size_t> sizes{2000, 20'000};
    Table table{"segments and bytes",
                {"fibres", "million segments", "bytes a point on the device", "culled / unculled", "million segments a second"},
                {}};
    std::vector<std::uint64_t> bytes, segments;
    for (const std::size_t size : sizes) {
        model::FibletSet set = ballOfFibres(size);
        bytes.push_back(std::span(set.heads).size_bytes() + std::span(set.codes).size_bytes() +
                        std::span(set.boxes).size_bytes() + std::span(set.pages).size_bytes());
        segments.push_back(set.points - set.fibres());
        store.add("fibres" + std::to_string(size), std::move(set));
    }
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    model::FrameRequest request;
    request.height = pictureHeight(device, options, kHeight, kHeight);
    request.width = request.height * 16 / 9;
    request.quality.samples = 1;
    request.scene.annotations.hidden = true;
    request.scene.layers.emplace_back().content = model::TractogramLayer{};
    const model::Camera start = renderer.fitCamera("fibres2000", {}, model::Convention::kRadiological,
                                                   static_cast<double>(request.width) / request.height);
    report.view = std::to_string(request.width) + "x" + std::to_string(request.height) + ", whole, one sample, lines lit";

    std::vector<render::Target> targets(sizes.size());
    render::Target unculled_target;
    std::vector<Series> culled, unculled;
    std::vector<std::function<void()>> measurements;
    int frame = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        culled.push_back({label(sizes[i], "culled, wall clock"), "ms", {}});
        unculled.push_back({label(sizes[i], "unculled, wall clock"), "ms", {}});
    }
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        measurements.push_back([&, i] {
            request.scene.layers[0].tracts().dataset_id = "fibres" + std::to_string(sizes[i]);
            request.camera = model::orbit(start, kDegreesPerFrame * frame++, 0);
            request.quality.fiblet_culling = model::FibletCulling::kTwoPhase;
            culled[i].values.push_back(renderer.render(targets[i], request, 0, 1).info.render_ms);
            request.quality.fiblet_culling = model::FibletCulling::kNone;
            unculled[i].values.push_back(renderer.render(unculled_target, request, 0, 1).info.render_ms);
        });
    }
    interleave(report.repeats, measurements);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        // The first is the warm-up, which knows no picture before.
        culled[i].values.erase(culled[i].values.begin());
        unculled[i].values.erase(unculled[i].values.begin());
        const double count = static_cast<double>(segments[i]);
        table.rows.push_back({std::to_string(sizes[i]), shortNumber(count * 1e-6),
                              shortNumber(static_cast<double>(bytes[i]) / (count + static_cast<double>(sizes[i]))),
                              shortNumber(culled[i].median() / unculled[i].median()),
                              shortNumber(count / unculled[i].median() * 1e-3)});
        report.series.push_back(culled[i]);
        report.series.push_back(unculled[i]);
    }
    report.tables.push_back(table);
    const double largest = static_cast<double>(segments.back());
    report.checks.push_back(
        {"million segments a second, unculled, whole frame", largest / unculled.back().median() * 1e-3, ">=", 20});
    report.checks.push_back({"culled / unculled, " + std::to_string(sizes.back()) + " fibres",
                             culled.back().median() / unculled.back().median(), "<=", 0.4});
    report.checks.push_back({"ten times the fibres, culled", culled.back().median() / culled.front().median(), "<=", 3});
    noteShortfalls(report, request.height, kHeight);
    return report;
}

}  // namespace radiata::lab
