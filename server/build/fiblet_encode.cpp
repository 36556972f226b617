#include "build/fiblet_encode.h"

#include <algorithm>
#include <cmath>
#include <future>

#include "base/error.h"
#include "build/fiblet_batches.h"

namespace radiata {
namespace {

constexpr std::size_t kBatchPoints = 1 << 20;

/// Caps from the whole sphere, for whatever comes, and from the largest turn downwards in constant ratios of their angles.
void setCaps(double largest_turn, shader::FibletCodec& codec) {
    const double first = std::clamp(largest_turn, 1e-3, 2.2);
    const double ratio =
        std::max(std::pow(first / 0.026, 1.0 / (shader::FIBLET_CAPS - 2)), 1.19);  // down to 1.5 degrees or less
    codec.cap_ratio[0] = 2;
    for (std::uint32_t i = 1; i < shader::FIBLET_CAPS; ++i)
        codec.cap_ratio[i] = float(1 - std::cos(first * std::pow(ratio, 1.0 - i)));
}

void addFibreColumns(const model::FibreBatch& batch, model::FibletSet& set) {
    for (std::size_t c = 0; c < set.fibre_columns.size(); ++c) {
        set.fibre_columns[c].values.insert(set.fibre_columns[c].values.end(), batch.fibre_values[c].begin(),
                                           batch.fibre_values[c].end());
    }
}

FibletProgress partOf(const FibletProgress& progress, double begin, double end) {
    return [&progress, begin, end](double share) {
        if (progress) progress(begin + (end - begin) * share);
    };
}

}  // namespace

FibletPlan planFiblets(const OpenTractogram& open, const FibletOptions& options, std::size_t batch_points,
                       const FibletProgress& progress) {
    if (!(options.bound_um > 0) || !(options.walk_bound_um > 0)) {
        throw Error(Code::kInvalidArgument, "the error bounds of fiblets are " + std::to_string(options.bound_um) + " and " +
                                                std::to_string(options.walk_bound_um) + " um; both would have to be above 0");
    }
    const std::unique_ptr<model::TractogramSource> source = open();
    const FibletMeasures measures = measureTractogram(*source, batch_points, partOf(progress, 0, 0.2));
    requireNarrowCells(open, measures.all, options.bound_um, batch_points);
    FibletPlan plan;
    plan.set.source = source->header().source;
    plan.set.bound_um = options.bound_um;
    const bool any = measures.all.points > 0;
    const glm::dvec3 low = any ? glm::dvec3(measures.all.bounds_min) : glm::dvec3(0),
                     high = any ? glm::dvec3(measures.all.bounds_max) : low;
    const glm::dvec3 size = high - low;
    plan.set.origin_mm = low;
    plan.set.codec.cell_mm = float(fibletCellMm(size));
    setCaps(measures.largest_turn, plan.set.codec);
    double kept = measures.keptStepMm(options.bound_um);
    if (measures.all.length_mm == 0 && measures.all.segments == 0) kept = 1;  // single points
    if (kept > 0 && kept <= options.longest_step_mm && (options.step_mm == 0 || options.step_mm == kept)) {
        plan.set.codec.step_mm = float(kept);
        return plan;
    }
    const WalkChoice choice = chooseWalk(*open(), measures, {options.step_mm, options.longest_step_mm, options.walk_bound_um},
                                         batch_points, partOf(progress, 0.2, 1));
    plan.set.walked = true;
    plan.set.walk_errors = choice.errors;
    plan.set.codec.step_mm = float(choice.step_mm);
    plan.walk_step_mm = choice.step_mm;
    return plan;
}

bool readFibreBatches(model::TractogramSource& source, std::size_t points,
                      const std::function<bool(const model::FibreBatch&)>& take, const FibletProgress& progress) {
    model::FibreBatch batch, next;
    bool more = source.read(batch, points);
    while (more) {
        auto reading = std::async(std::launch::async, [&] { return source.read(next, points); });
        if (!take(batch)) return false;
        more = reading.get();
        std::swap(batch, next);
        if (progress) progress(shareRead(source));
    }
    return true;
}

namespace {

model::FibletSet encodeAtOnce(const OpenTractogram& open, const FibletOptions& options, const FibletProgress& progress) {
    const FibletPlan plan = planFiblets(open, options, kBatchPoints, partOf(progress, 0, 0.25));
    const std::unique_ptr<model::TractogramSource> source = open();
    const FibletBatches batches(plan, source->header(), options);
    model::FibletSet set = plan.set;
    for (const model::ColumnName& column : source->header().fibre_columns)
        set.fibre_columns.push_back({column.name, std::uint32_t(column.components), {}});
    FibletBlock all = batches.begin();
    std::uint64_t fibres = 0;
    const auto take = [&](const model::FibreBatch& batch) {
        batches.encode(batch, 0, all);
        addFibreColumns(batch, set);
        fibres += batch.fibreCount();
        return true;
    };
    readFibreBatches(*source, kBatchPoints, take, partOf(progress, 0.25, 1));
    set.groups = source->groups();
    set.remarks = remarksOf(*source);
    set.points = all.points;
    set.errors = all.errors();
    const std::vector<std::uint32_t> order = arrangeFiblets(set, all.fiblets, all.heap, fibres);
    set.point_columns = batches.columns();
    for (std::size_t c = 0; c < set.point_columns.size(); ++c) {
        model::PointColumn& column = set.point_columns[c];
        column.ranges.reserve(order.size());
        column.values.reserve(64 * order.size());
        for (const std::uint32_t i : order) {
            column.ranges.push_back(all.ranges[c][i]);
            column.values.insert(column.values.end(), all.values[c].begin() + 64L * i, all.values[c].begin() + 64L * (i + 1));
        }
    }
    return set;
}

}  // namespace

model::FibletSet encodeFiblets(const OpenTractogram& open, const FibletOptions& options, const FibletProgress& progress) {
    const auto encode = [&](const OpenTractogram& of) {
        return encodeWithFinerSteps(
            options, [&](const FibletOptions& now) { return encodeAtOnce(of, now, progress); }, [](const UnheldBound&) {});
    };
    return encodeWithoutStrays(open, options, kBatchPoints, encode, [](const StrayFibres&) {});
}

model::FibletSet encodeFiblets(const model::Tractogram& tractogram, const FibletOptions& options) {
    return encodeFiblets([&] { return model::sourceOf(tractogram); }, options);
}

model::FibletSet encodeFiblets(std::span<const glm::vec3> points, std::span<const std::uint64_t> offsets,
                               const FibletOptions& options) {
    model::Tractogram tractogram;
    tractogram.header.source = tractogram.header.format = "memory";
    tractogram.fibres.points.assign(points.begin(), points.end());
    tractogram.fibres.offsets.assign(offsets.begin(), offsets.end());
    return encodeFiblets(tractogram, options);
}

}  // namespace radiata
