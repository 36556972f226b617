// isosurface-hits: the cubic's solver on random chords, and primary rays with and without bricks, exact and marched.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "build/folded_ball.h"
#include "build/marching_cubes.h"
#include "reference/scalar_field.h"
#include "store/store.h"
#include "tools/lab/chords.h"
#include "tools/lab/experiments.h"
#include "tools/lab/isosurface_scenes.h"
#include "tools/lab/measure.h"
#include "tools/lab/statistics.h"

namespace radiata::lab {
namespace {

constexpr std::uint64_t kChords = 4'000'000;

void addChords(gpu::Device& device, Report& report) {
    const ChordErrors errors = measureChords(device, kChords);
    const double p9999 = quantile(errors.cells, 0.9999);
    report.tables.push_back(
        {"first roots along " + std::to_string(kChords) + " random chords, float against subdivision in double",
         {"hits", "between ends of one sign", "missed", "invented", "median, cells", "99 %", "99.99 %", "largest",
          "ns per chord"},
         {{std::to_string(errors.hits), std::to_string(errors.even), std::to_string(errors.missed),
           std::to_string(errors.invented), shortNumber(median(errors.cells)), shortNumber(quantile(errors.cells, 0.99)),
           shortNumber(p9999), shortNumber(quantile(errors.cells, 1)), shortNumber(errors.ns_per_chord)}}});
    report.checks.push_back({"missed chords", static_cast<double>(errors.missed), "<=", 0});
    report.checks.push_back({"error at 99.99 %, cells", p9999, "<=", 2e-5});
}

struct Variant {
    std::string name;
    model::IsosurfaceSettings settings;
};

std::vector<Variant> variants() {
    std::vector<Variant> all = {{"exact", {}}, {"exact, no bricks", {}}, {"march-bisect 0.5", {}}, {"march-bisect 0.125", {}}};
    all[1].settings.bricks = false;
    all[2].settings.method = all[3].settings.method = model::SurfaceMethod::kMarchBisect;
    all[3].settings.step = 0.125F;
    return all;
}

/// Pixels where another surface is shown than by the first: beside it, behind it, or none.
std::string wrongPixels(const Measured& first, const Measured& other, double tolerance_mm) {
    int hits = 0, wrong = 0;
    for (std::size_t i = 0; i < first.depth.size(); ++i) {
        const bool hit = std::isfinite(first.depth[i]);
        hits += hit || std::isfinite(other.depth[i]);
        if (hit != std::isfinite(other.depth[i]))
            ++wrong;
        else if (hit && std::abs(static_cast<double>(first.depth[i]) - static_cast<double>(other.depth[i])) > tolerance_mm)
            ++wrong;
    }
    return shortNumber(100.0 * wrong / std::max(hits, 1));
}

void addVolume(render::Renderer& renderer, store::Store& store, int size, int height, double bound, Report& report) {
    const std::string id = "ball" + std::to_string(size), title = std::to_string(size) + "^3";
    const model::ScalarImage image = foldedBall(size);
    store.add(id, image);
    std::vector<Candidate> candidates;
    for (const Variant& variant : variants()) {
        model::FrameRequest request = surfaceRequest(image, id, 30.0F, height, {2, -3, 1.5});
        request.quality.isosurface = variant.settings;
        candidates.push_back({variant.name, title, request});
    }
    const std::vector<Measured> measured = measure(renderer, candidates, report.repeats, {"isosurface"});
    Table table{title + ": primary rays", {"method", "ms", "spread", "times exact", "wrong pixels, %"}, {}};
    for (const Measured& method : measured) {
        Series series = method.time;
        series.name = title + ", " + method.name;
        report.series.push_back(series);
        table.rows.push_back({method.name, shortNumber(series.median()), shortNumber(series.spread()),
                              shortNumber(series.median() / measured[0].time.median()),
                              wrongPixels(measured[0], method, 0.01)});
    }
    report.tables.push_back(table);
    report.checks.push_back(
        {title + ": without bricks / with", measured[1].time.median() / measured[0].time.median(), ">=", bound});
}

/// What triangles of marching cubes are off by: the distance of their middles from the surface, to first order.
void addTriangles(Report& report) {
    Table table{"marching-cubes: triangles, which stand for one isovalue",
                {"volume", "seconds to extract", "triangles", "MiB", "middle off by, median, voxels", "99 %", "largest"},
                {}};
    for (const int size : {96, 256}) {
        const model::ScalarImage image = foldedBall(size);
        const reference::ScalarField volume(image);
        Series seconds;
        SurfaceMesh mesh;
        for (int i = 0; i < 3; ++i) {
            const auto begin = std::chrono::steady_clock::now();
            mesh = marchCubes(image, 30);
            seconds.values.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        }
        std::vector<double> off;
        for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
            const glm::dvec3 middle =
                (glm::dvec3(mesh.positions[mesh.triangles[t]]) + glm::dvec3(mesh.positions[mesh.triangles[t + 1]]) +
                 glm::dvec3(mesh.positions[mesh.triangles[t + 2]])) /
                3.0;
            off.push_back(std::abs(volume.value(middle) - 30) / std::max(glm::length(volume.gradient(middle)), 1e-9));
        }
        const double mib = static_cast<double>(mesh.positions.size() * 24 + mesh.triangles.size() * 4) / (1 << 20);
        table.rows.push_back({std::to_string(size) + "^3", shortNumber(seconds.median()),
                              std::to_string(mesh.triangles.size() / 3), shortNumber(mib), shortNumber(median(off)),
                              shortNumber(quantile(off, 0.99)), shortNumber(quantile(off, 1))});
    }
    report.tables.push_back(table);
    report.notes.push_back("marching-cubes runs on one core; a new isovalue needs new triangles, exact hits need nothing");
}

}  // namespace

Report isosurfaceHits(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "isosurface-hits";
    report.repeats = options.rounds(7);
    report.scene = "folded ball, isovalue 30; random cells";
    store::Store store(device, {});
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    const int height = options.size > 0 ? options.size : 512;
    report.view = std::to_string(height) + "x" + std::to_string(height) + ", perspective, one sample per pixel";
    addChords(device, report);
    addVolume(renderer, store, 96, height, 2, report);
    addVolume(renderer, store, 256, height, 3, report);
    addTriangles(report);
    report.notes.push_back(
        "wrong pixels: another surface, or none, more than 0.01 mm (voxels are 1 mm) away from the exact hit");
    noteShortfalls(report, height, 512);
    return report;
}

}  // namespace radiata::lab
