#include "build/fiblet_measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <span>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "build/fiblet_walk.h"

namespace radiata {
namespace {

constexpr int kSteps = 40;  ///< tried ones at most, each 1 / sqrt(2) of the one before

double turnAt(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const glm::dvec3 u = b - a, v = c - b;
    return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

/// Of the fibre that would have too many steps. \param source  not yet read from
[[noreturn]] void refuseSteps(model::TractogramSource& source, std::size_t batch_points, double step_mm, double most) {
    double longest = -1;
    std::uint64_t fibre = 0;
    std::size_t points = 0;
    model::FibreBatch batch;
    while (source.read(batch, batch_points)) {
        for (std::size_t f = 0; f < batch.fibreCount(); ++f) {
            const std::span<const glm::vec3> p = batch.fibre(f);
            double length = 0;
            for (std::size_t i = 1; i < p.size(); ++i) length += glm::distance(glm::dvec3(p[i]), glm::dvec3(p[i - 1]));
            if (length <= longest) continue;
            longest = length;
            fibre = batch.first_fibre + f;
            points = p.size();
        }
    }
    std::array<char, 320> text{};
    std::snprintf(
        text.data(), text.size(),
        ": fibre %llu has %zu points on %.6g mm; a fibre has at most %.0f steps, and those of %.4g mm would be %.0f of "
        "it; take steps of %.4g mm or more (radiata-convert --step, with --walk-bound if the line turns sharply), or "
        "leave the fibre out",
        static_cast<unsigned long long>(fibre), points, longest, most, step_mm, std::ceil(longest / step_mm),
        1.001 * longest / (most - 1));
    throw Error(Code::kInvalidArgument, source.header().source + text.data());
}

}  // namespace

double FibletMeasures::keptStepMm(double bound_um) const {
    if (all.inner_segments == 0) return longest_last_mm;
    const double mean = all.inner_length_mm / double(all.inner_segments);
    const double rounding = std::sqrt(3.0) * longest_reach_mm * 0x1p-23;
    const double slack = std::min(0.01 * mean, bound_um * 1e-3 / 16) + rounding;
    const bool alike =
        all.longest_segment_mm - mean <= slack && mean - all.shortest_segment_mm <= slack && longest_last_mm - mean <= slack;
    return alike && mean > 0 ? mean : 0;
}

FibletMeasures measureTractogram(model::TractogramSource& source, std::size_t batch_points, const FibletProgress& progress) {
    FibletMeasures measures;
    model::FibreBatch batch;
    std::mutex mutex;
    while (source.read(batch, batch_points)) {
        measures.all.add(batch);
        parallelFor(batch.fibreCount(), 64, [&](std::size_t begin, std::size_t end) {
            double last = 0, turn = 0;
            for (std::size_t f = begin; f < end; ++f) {
                const std::span<const glm::vec3> p = batch.fibre(f);
                const auto bad = std::find_if(p.begin(), p.end(), [](glm::vec3 q) { return !std::isfinite(q.x + q.y + q.z); });
                if (bad != p.end()) {
                    throw Error(Code::kInvalidArgument, source.header().source + ": point " + std::to_string(bad - p.begin()) +
                                                            " of fibre " + std::to_string(batch.first_fibre + f) +
                                                            " is not finite");
                }
                if (p.size() > 1)
                    last = std::max(last, glm::distance(glm::dvec3(p[p.size() - 1]), glm::dvec3(p[p.size() - 2])));
                for (std::size_t i = 2; i < p.size(); ++i) {
                    turn = std::max(turn, turnAt(glm::dvec3(p[i - 2]), glm::dvec3(p[i - 1]), glm::dvec3(p[i])));
                }
            }
            std::lock_guard lock(mutex);
            measures.longest_last_mm = std::max(measures.longest_last_mm, last);
            measures.largest_turn = std::max(measures.largest_turn, turn);
        });
        if (progress) progress(shareRead(source));
    }
    if (measures.all.points > 0) {
        const glm::vec3 reach = glm::max(glm::abs(measures.all.bounds_min), glm::abs(measures.all.bounds_max));
        measures.longest_reach_mm = std::max({reach.x, reach.y, reach.z});
    }
    return measures;
}

WalkChoice chooseWalk(model::TractogramSource& source, const FibletMeasures& measures, const WalkWish& wish,
                      std::size_t batch_points, const FibletProgress& progress) {
    struct Trial {
        double step_mm = 0, sum_mm = 0, max_mm = 0;
        std::uint64_t worst = 0;
    };
    const double segments = double(std::max<std::uint64_t>(measures.all.segments, 1));
    const double mean = measures.all.length_mm > 0 ? measures.all.length_mm / segments : 1;
    constexpr double kMost = double(shader::FIBLET_SEGMENTS) * model::kFibletsPerFibre;
    // Steps so short that a fibre would have too many are of no use, whatever its mean segment.
    const double longest = std::min(std::max(mean, 1.0001 * measures.all.longest_fibre_mm / (kMost - 1)), wish.longest_mm);
    std::vector<Trial> trials;
    for (int i = 0; i < (wish.step_mm > 0 ? 1 : kSteps); ++i) {
        const double step = wish.step_mm > 0 ? wish.step_mm : longest * std::exp2(-0.5 * i);
        if (i > 0 && 1e3 * trials.back().step_mm <= wish.bound_um) break;  // no vertex is farther away than a step
        if (measures.all.longest_fibre_mm / step < kMost - 1) {
            trials.push_back({step});
        } else if (i > 0) {
            break;
        } else {
            refuseSteps(source, batch_points, step, kMost);
        }
    }
    model::FibreBatch batch;
    std::mutex mutex;
    while (source.read(batch, batch_points)) {
        std::vector<double> sums(trials.size() * batch.fibreCount()), maxima(sums.size());
        parallelFor(batch.fibreCount(), 16, [&](std::size_t begin, std::size_t end) {
            Walk one;
            for (std::size_t f = begin; f < end; ++f) {
                for (std::size_t t = 0; t < trials.size(); ++t) {
                    walk(batch.fibre(f), trials[t].step_mm, one);
                    sums[f * trials.size() + t] = one.sum_error_mm;
                    maxima[f * trials.size() + t] = one.max_error_mm;
                }
            }
        });
        for (std::size_t i = 0; i < sums.size(); ++i) {
            Trial& trial = trials[i % trials.size()];
            trial.sum_mm += sums[i];
            if (maxima[i] > trial.max_mm) trial.worst = batch.first_fibre + i / trials.size();
            trial.max_mm = std::max(trial.max_mm, maxima[i]);
        }
        if (progress) progress(shareRead(source));
    }
    for (const Trial& trial : trials) {
        if (1e3 * trial.max_mm > wish.bound_um) continue;
        const double points = double(std::max<std::uint64_t>(measures.all.points, 1));
        return {trial.step_mm, {1e3 * trial.sum_mm / points, 1e3 * trial.max_mm, measures.all.points}};
    }
    const Trial& best = *std::min_element(trials.begin(), trials.end(), [](auto& a, auto& b) { return a.max_mm < b.max_mm; });
    throw Error(Code::kInvalidArgument, source.header().source + ": the points of fibre " + std::to_string(best.worst) +
                                            " cannot be kept within " + std::to_string(wish.bound_um) +
                                            " um of a line with steps of " + std::to_string(best.step_mm) +
                                            " mm; it would take " + std::to_string(1e3 * best.max_mm) +
                                            " um (radiata-convert --walk-bound), or a smaller step (--step)");
}

}  // namespace radiata
