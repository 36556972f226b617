#include "tools/lab/accuracy.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "base/parallel.h"
#include "tools/lab/statistics.h"
#include "tools/lab/truth.h"

namespace radiata::lab {
namespace {

constexpr std::size_t kExtraMost = 20000;  // pixels looked at only because methods differ there

struct Tally {
    Errors errors;
    std::size_t sampled = 0, sampled_wrong = 0;
    std::vector<double> depth, normal;
};

/// Pixels of a regular grid, then those where a method differs from the first one.
std::vector<std::size_t> pixelsToTrace(const model::FrameRequest& request, const std::vector<Measured>& measured, int sample,
                                       double radius, std::size_t& regular) {
    const int stride = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(request.width) * request.height / sample)));
    std::vector<std::size_t> grid, extra;
    for (int y = 0; y < request.height; ++y) {
        for (int x = 0; x < request.width; ++x) {
            const std::size_t at =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(request.width) + static_cast<std::size_t>(x);
            if (x % stride == stride / 2 && y % stride == stride / 2) {
                grid.push_back(at);
                continue;
            }
            for (const Measured& method : measured) {
                const float a = method.depth[at], b = measured[0].depth[at];
                const double shift = method.info.depth_offset_mm - measured[0].info.depth_offset_mm;
                if (std::isinf(a) != std::isinf(b) ||
                    (!std::isinf(a) &&
                     std::abs(static_cast<double>(a) + shift - static_cast<double>(b)) > kWrongRadii * radius)) {
                    extra.push_back(at);
                    break;
                }
            }
        }
    }
    regular = grid.size();
    const std::size_t step = extra.size() / kExtraMost + 1;
    for (std::size_t i = 0; i < extra.size(); i += step) grid.push_back(extra[i]);
    return grid;
}

void compare(const Measured& method, std::size_t at, const TrueHit& truth, bool regular, Tally& tally) {
    Errors& errors = tally.errors;
    ++errors.compared;
    const bool drawn = !std::isinf(method.depth[at]);
    bool wrong = drawn != truth.hit;
    errors.missed += truth.hit && !drawn;
    errors.false_hits += drawn && !truth.hit;
    if (drawn && truth.hit) {
        const double depth = static_cast<double>(method.depth[at]) + method.info.depth_offset_mm;
        const double error = std::abs(depth - truth.depth_mm) / truth.radius_mm;
        wrong = !(error <= kWrongRadii);
        if (regular) {
            const glm::dvec3 n(method.normal[3 * at], method.normal[3 * at + 1], method.normal[3 * at + 2]);
            const double degrees = std::atan2(glm::length(glm::cross(n, truth.normal)), glm::dot(n, truth.normal));
            tally.depth.push_back(error);
            tally.normal.push_back(degrees * 180 / std::numbers::pi);
        }
    }
    errors.wrong += wrong;
    tally.sampled += regular;
    tally.sampled_wrong += regular && wrong;
}

Errors summed(const std::vector<Tally>& parts) {
    Errors sum;
    std::vector<double> depth, normal;
    std::size_t sampled = 0, sampled_wrong = 0;
    for (const Tally& part : parts) {
        sum.compared += part.errors.compared;
        sum.left_out += part.errors.left_out;
        sum.missed += part.errors.missed;
        sum.false_hits += part.errors.false_hits;
        sum.wrong += part.errors.wrong;
        sampled += part.sampled;
        sampled_wrong += part.sampled_wrong;
        depth.insert(depth.end(), part.depth.begin(), part.depth.end());
        normal.insert(normal.end(), part.normal.begin(), part.normal.end());
    }
    sum.wrong_share = sampled > 0 ? static_cast<double>(sampled_wrong) / static_cast<double>(sampled) : 0;
    sum.depth_p50 = quantile(depth, 0.5);
    sum.depth_p99 = quantile(depth, 0.99);
    sum.depth_max = quantile(depth, 1);
    sum.normal_p50 = quantile(normal, 0.5);
    sum.normal_p99 = quantile(normal, 0.99);
    sum.normal_max = quantile(normal, 1);
    return sum;
}

}  // namespace

std::vector<Errors> compareWithReference(store::Store& store, const model::FrameRequest& request,
                                         const std::vector<Measured>& measured, int sample) {
    const Truth truth(store, request);
    std::size_t regular = 0;
    const std::vector<std::size_t> pixels = pixelsToTrace(request, measured, sample, truth.largestRadiusMm(), regular);
    std::vector<std::vector<Tally>> parts(measured.size());
    std::mutex mutex;
    parallelFor(pixels.size(), 32, [&](std::size_t begin, std::size_t end) {
        std::vector<Tally> own(measured.size());
        for (std::size_t i = begin; i < end; ++i) {
            const auto width = static_cast<std::size_t>(request.width);
            const TrueHit hit = truth.at(static_cast<int>(pixels[i] % width), static_cast<int>(pixels[i] / width));
            for (std::size_t m = 0; m < measured.size(); ++m) {
                if (hit.decided) {
                    compare(measured[m], pixels[i], hit, i < regular, own[m]);
                } else {
                    ++own[m].errors.left_out;
                }
            }
        }
        const std::lock_guard lock(mutex);
        for (std::size_t m = 0; m < measured.size(); ++m) parts[m].push_back(std::move(own[m]));
    });
    std::vector<Errors> errors;
    for (const auto& method : parts) errors.push_back(summed(method));
    return errors;
}

}  // namespace radiata::lab
