// peters-fig3: roots in powers of the ray parameter against roots in the turned frame, in single precision, from several
// distances. Both on the CPU by the same code, as the first serves no other purpose.
// Source: Peters et al. 2023, Fig. 3 and Sec. 3.3.
#include <array>
#include <cmath>
#include <mutex>

#include "base/parallel.h"
#include "gpu/device.h"
#include "reference/glyph_hits.h"
#include "tools/lab/accuracy.h"
#include "tools/lab/experiments.h"
#include "tools/lab/float_polynomial.h"
#include "tools/lab/scenes.h"
#include "tools/lab/statistics.h"

namespace radiata::lab {
namespace {

constexpr int kPaperSize = 256, kReducedSize = 64;
constexpr double kRadius = 1.6;  // of the picture, in amplitudes; the glyph's is 1.3 to 1.5

struct Count {
    std::size_t compared = 0, left_out = 0, missed = 0, false_hits = 0, wrong = 0;
    std::vector<double> depth;
};

/// Rays through a square of the plane at the centre, from a point at some distance.
std::array<Count, 2> compareFrom(double distance, int size, int k, const std::vector<float>& glyph) {
    const reference::ShFunction f({k, false}, std::span<const float>(glyph));
    const FloatPolynomial solver(k, glyph);
    const glm::dvec3 forward = -glm::normalize(glm::dvec3(0.3, -0.5, 4));
    const glm::dvec3 right = reference::anyOrthogonal(forward), up = glm::cross(right, forward);
    std::array<Count, 2> sum;
    std::mutex mutex;
    parallelFor(static_cast<std::size_t>(size), 2, [&](std::size_t begin, std::size_t end) {
        std::array<Count, 2> own;
        for (std::size_t y = begin; y < end; ++y) {
            for (int x = 0; x < size; ++x) {
                const double px = (2 * (x + 0.5) / size - 1) * kRadius,
                             py = (2 * (static_cast<double>(y) + 0.5) / size - 1) * kRadius;
                const glm::vec3 origin(-distance * forward);
                const glm::vec3 direction(glm::normalize(px * right + py * up + distance * forward));
                // The reference traces the ray that the float numbers say.
                const auto truth = reference::glyphHits(f, origin, glm::normalize(glm::dvec3(direction)), true, 0);
                for (std::size_t i = 0; i < 2; ++i) {
                    Count& count = own[i];
                    if (!(truth.first_shift < 1e-3)) {
                        ++count.left_out;
                        continue;
                    }
                    ++count.compared;
                    const float t =
                        solver.firstHit(origin, direction, i == 0 ? RayCoordinate::kRayParameter : RayCoordinate::kTurnedFrame);
                    const bool hit = !truth.hits.empty(), found = std::isfinite(t);
                    count.missed += hit && !found;
                    count.false_hits += found && !hit;
                    const double error = hit && found ? std::abs(static_cast<double>(t) - truth.hits[0].t) : 0;
                    if (hit && found) count.depth.push_back(error);
                    count.wrong += hit != found || error > kWrongRadii;
                }
            }
        }
        const std::lock_guard lock(mutex);
        for (std::size_t i = 0; i < 2; ++i) {
            sum[i].compared += own[i].compared;
            sum[i].left_out += own[i].left_out;
            sum[i].missed += own[i].missed;
            sum[i].false_hits += own[i].false_hits;
            sum[i].wrong += own[i].wrong;
            sum[i].depth.insert(sum[i].depth.end(), own[i].depth.begin(), own[i].depth.end());
        }
    });
    return sum;
}

}  // namespace

Report petersFig3(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "peters-fig3";
    report.repeats = 1;
    report.device = "CPU, single precision";
    const int size = pictureHeight(device, options, kPaperSize, kReducedSize);
    report.scene = "one glyph of three crossing lobes, both signs, k = 4 (the paper's) and 8";
    report.view = std::to_string(size) + "x" + std::to_string(size) + ", perspective, from 3 to 300 amplitudes away";
    Table table{"wrong pixels",
                {"k, distance", "coordinate", "compared", "left out", "missed", "false", "wrong px", "depth p50", "p99", "max"},
                {}};
    Plot plot{
        "wrong pixels over the distance", "distance of the eye, amplitudes", "share of wrong pixels", true, true, false, {}};
    for (const int k : {4, 8}) {
        Curve parameter{"k = " + std::to_string(k) + ", powers of the ray parameter", {}, true};
        Curve turned{"k = " + std::to_string(k) + ", turned frame", {}, true};
        for (const double distance : {3.0, 10.0, 30.0, 100.0, 300.0}) {
            const auto counts = compareFrom(distance, size, k, fibreLobes(k));
            for (std::size_t i = 0; i < 2; ++i) {
                const Count& c = counts[i];
                table.rows.push_back({"k = " + std::to_string(k) + ", " + shortNumber(distance),
                                      i == 0 ? "ray parameter" : "turned frame", std::to_string(c.compared),
                                      std::to_string(c.left_out), std::to_string(c.missed), std::to_string(c.false_hits),
                                      std::to_string(c.wrong), shortNumber(quantile(c.depth, 0.5)),
                                      shortNumber(quantile(c.depth, 0.99)), shortNumber(quantile(c.depth, 1))});
                (i == 0 ? parameter : turned)
                    .points.push_back({distance, static_cast<double>(c.wrong) / static_cast<double>(c.compared), ""});
            }
            report.checks.push_back(
                {"k = " + std::to_string(k) + ", distance " + shortNumber(distance) + ": wrong, turned - ray parameter",
                 static_cast<double>(counts[1].wrong) - static_cast<double>(counts[0].wrong), "<=", 0});
        }
        plot.curves.push_back(std::move(parameter));
        plot.curves.push_back(std::move(turned));
    }
    report.tables.push_back(std::move(table));
    report.plots.push_back(std::move(plot));
    report.notes.push_back(
        "No times: both solvers run on the CPU. wrong: missed, false or off by over 2e-3 amplitudes; left out: the first hit "
        "moves "
        "by over 1e-3 radii when the ray moves by 1e-5. The paper's glyph is not at hand.");
    return report;
}

}  // namespace radiata::lab
