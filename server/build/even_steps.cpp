#include "build/even_steps.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "build/fibre_strays.h"

namespace radiata {
namespace {

constexpr int kHalvings = 48;      ///< of the interval in which a step is looked for
constexpr int kMoreSegments = 4;   ///< tried where no step makes the number that was wanted
constexpr double kDriftMm = 0.05;  ///< of the end, by steps that are a little unlike the first

double lengthOf(std::span<const glm::vec3> fibre) {
    double length = 0;
    for (std::size_t i = 1; i < fibre.size(); ++i) length += glm::distance(glm::dvec3(fibre[i]), glm::dvec3(fibre[i - 1]));
    return length;
}

/// What rounding coordinates to float can do to a segment's length.
double roundingOf(std::span<const glm::vec3> fibre) {
    float reach = 0;
    for (const glm::vec3& p : fibre) reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return std::sqrt(3.0) * double(reach) * 0x1p-23;
}

/// The least step with at most so many segments; the last is as long as the others there, unless the line jumps out of a ball.
bool walkSegments(std::span<const glm::vec3> fibre, double length, std::size_t segments, double rounding, Walk& out) {
    double many = 0, few = length * (1 + 1e-9);
    for (int i = 0; i < kHalvings; ++i) {
        const double step = i == 0 ? 0.5 * length / double(segments) : 0.5 * (many + few);
        walk(fibre, step, out);
        (out.points.size() - 1 <= segments ? few : many) = step;
    }
    walk(fibre, few, out);
    const std::size_t n = out.points.size();
    if (n < 2 || n - 1 != segments) return false;
    const double last = glm::distance(glm::dvec3(out.points[n - 1]), glm::dvec3(out.points[n - 2]));
    return std::abs(last - few) <= 1e-3 * few + rounding;
}

}  // namespace

bool hasEvenSteps(std::span<const glm::vec3> fibre) {
    if (fibre.size() < 3) return true;
    const double first = glm::distance(glm::dvec3(fibre[1]), glm::dvec3(fibre[0])), rounding = roundingOf(fibre);
    double drift = 0;
    for (std::size_t i = 2; i < fibre.size(); ++i) {
        const double more = glm::distance(glm::dvec3(fibre[i]), glm::dvec3(fibre[i - 1])) - first;
        if (std::abs(more) > 0.01 * first + rounding) return false;
        drift += more;
    }
    return std::abs(drift) <= kDriftMm + rounding * double(fibre.size());
}

bool walkEvenly(std::span<const glm::vec3> fibre, const EvenStepWish& wish, Walk& out) {
    const double length = lengthOf(fibre), rounding = roundingOf(fibre);
    if (fibre.size() < 2 || length == 0) {
        walk(fibre, 1, out);
        out.points.assign(fibre.begin(), fibre.end());
        return true;
    }
    double step = wish.step_mm > 0 ? wish.step_mm : length / double(fibre.size() - 1);
    for (;; step *= std::sqrt(0.5)) {
        const auto segments = std::size_t(std::max(1.0, std::ceil(length / step * (1 - 1e-6))));
        if (segments + kMoreSegments >= wish.most) return false;
        for (std::size_t more = 0; more <= kMoreSegments; ++more) {
            if (walkSegments(fibre, length, segments + more, rounding, out) && 1e3 * out.max_error_mm <= wish.bound_um)
                return true;
        }
        // No vertex is farther from the new line than a step.
        if (wish.step_mm > 0 || 2e3 * step < wish.bound_um) return false;
    }
}

EvenSteps::EvenSteps(std::unique_ptr<model::TractogramSource> source, const EvenStepWish& wish, EvenStepTally& tally)
    : source_(std::move(source)), wish_(wish), header_(source_->header()), tally_(tally) {
    tally_ = {};
    header_.vertex_columns.clear();
    header_.fibre_columns.clear();
    header_.point_count.reset();
}

bool EvenSteps::read(model::FibreBatch& batch, std::size_t points_wanted) {
    const bool more = source_->read(own_, points_wanted);
    batch.clear(0, 0);
    if (!more) {
        tally_.remarks = remarksOf(*source_);
        return false;
    }
    std::vector<Walk> walks(own_.fibreCount());
    std::vector<char> walked(own_.fibreCount());
    parallelFor(own_.fibreCount(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            if (hasEvenSteps(own_.fibre(f))) continue;
            walked[f] = 1;
            if (!walkEvenly(own_.fibre(f), wish_, walks[f])) walks[f].points.clear();
        }
    });
    batch.first_fibre = own_.first_fibre;
    batch.first_point = point_;
    for (std::size_t f = 0; f < own_.fibreCount(); ++f) {
        const std::span<const glm::vec3> points = walked[f] ? std::span<const glm::vec3>(walks[f].points) : own_.fibre(f);
        if (walked[f] && points.empty()) {
            throw Error(Code::kInvalidArgument, header_.source + ": the steps of fibre " +
                                                    std::to_string(own_.first_fibre + f) +
                                                    " vary, and no constant one of at most " + std::to_string(wish_.most) +
                                                    " points keeps its points within " + std::to_string(wish_.bound_um) +
                                                    " um; a larger --walk-bound would, or another --step");
        }
        if (walked[f]) {
            model::FibletErrors& errors = tally_.errors;
            ++tally_.walked;
            sum_mm_ += walks[f].sum_error_mm;
            errors.points += own_.fibre(f).size();
            errors.mean_um = 1e3 * sum_mm_ / double(errors.points);
            errors.max_um = std::max(errors.max_um, 1e3 * walks[f].max_error_mm);
        }
        batch.points.insert(batch.points.end(), points.begin(), points.end());
        batch.offsets.push_back(batch.points.size());
    }
    point_ += batch.points.size();
    return true;
}

}  // namespace radiata
