#include "build/fiblet_encode.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <numeric>

#include "base/error.h"
#include "base/parallel.h"
#include "build/fiblet_block.h"
#include "build/fiblet_walk.h"

namespace radiata {
namespace {

constexpr std::size_t kBatchPoints = 1 << 20, kFibresPerBlock = 8;

/// Caps from the whole sphere, for whatever comes, and from the largest turn downwards in constant ratios of their angles.
void setCaps(double largest_turn, shader::FibletCodec& codec) {
    const double first = std::clamp(largest_turn, 1e-3, 2.2);
    const double ratio =
        std::max(std::pow(first / 0.026, 1.0 / (shader::FIBLET_CAPS - 2)), 1.19);  // down to 1.5 degrees or less
    codec.cap_ratio[0] = 2;
    for (std::uint32_t i = 1; i < shader::FIBLET_CAPS; ++i)
        codec.cap_ratio[i] = float(1 - std::cos(first * std::pow(ratio, 1.0 - i)));
}

/// One component of one vertex column of a batch, per point of the batch.
struct Component {
    std::size_t column = 0;
    int component = 0, of = 1;
};

std::vector<Component> componentsOf(const model::TractogramHeader& header) {
    std::vector<Component> all;
    for (std::size_t c = 0; c < header.vertex_columns.size(); ++c) {
        for (int k = 0; k < header.vertex_columns[c].components; ++k)
            all.push_back({c, k, header.vertex_columns[c].components});
    }
    return all;
}

class Batches {
public:
    Batches(const FibletEncoder& encoder, double walk_step_mm, std::vector<Component> components)
        : encoder_(encoder), walk_step_mm_(walk_step_mm), components_(std::move(components)) {}

    void encode(const model::FibreBatch& batch, FibletBlock& all) const {
        std::vector<FibletBlock> blocks((batch.fibreCount() + kFibresPerBlock - 1) / kFibresPerBlock);
        parallelFor(batch.fibreCount(), kFibresPerBlock, [&](std::size_t begin, std::size_t end) {
            FibletBlock& block = blocks[begin / kFibresPerBlock];
            prepare(block);
            Walk walked;
            std::vector<std::vector<float>> values(components_.size());
            for (std::size_t f = begin; f < end; ++f) {
                if (batch.fibre(f).empty()) continue;
                if (walk_step_mm_ > 0) walk(batch.fibre(f), walk_step_mm_, walked);
                const std::span<const glm::vec3> points =
                    walk_step_mm_ > 0 ? std::span<const glm::vec3>(walked.points) : batch.fibre(f);
                for (std::size_t c = 0; c < components_.size(); ++c) {
                    values[c].resize(points.size());
                    for (std::size_t i = 0; i < points.size(); ++i) {
                        values[c][i] = value(batch, f, c, walk_step_mm_ > 0 ? walked.places[i] : double(i));
                    }
                }
                encoder_.encode(points, values, batch.first_fibre + f, block);
            }
        });
        for (const FibletBlock& block : blocks) all.append(block);
    }

    void prepare(FibletBlock& block) const {
        block.ranges.resize(components_.size());
        block.values.resize(components_.size());
    }

private:
    float value(const model::FibreBatch& batch, std::size_t f, std::size_t c, double place) const {
        const Component& from = components_[c];
        const float* first = batch.vertex_values[from.column].data() + batch.offsets[f] * from.of + from.component;
        const auto before = std::size_t(place);
        const double fraction = place - double(before);
        const float a = first[before * from.of];
        return fraction > 0 ? float(a + fraction * (double(first[(before + 1) * from.of]) - a)) : a;
    }

    const FibletEncoder& encoder_;
    double walk_step_mm_;
    std::vector<Component> components_;
};

void addFibreColumns(const model::FibreBatch& batch, model::FibletSet& set) {
    for (std::size_t c = 0; c < set.fibre_columns.size(); ++c) {
        set.fibre_columns[c].values.insert(set.fibre_columns[c].values.end(), batch.fibre_values[c].begin(),
                                           batch.fibre_values[c].end());
    }
}

/// The last pass. \param walk_step_mm  0: points stay
model::FibletSet encodeAll(const OpenTractogram& open, model::FibletSet set, double walk_step_mm, const FibletOptions& options,
                           const FibletProgress& progress) {
    const std::unique_ptr<model::TractogramSource> source = open();
    const model::TractogramHeader& header = source->header();
    const std::vector<Component> components = componentsOf(header);
    for (const model::ColumnName& column : header.fibre_columns)
        set.fibre_columns.push_back({column.name, std::uint32_t(column.components), {}});
    const FibletEncoder encoder(set.codec, set.origin_mm, options, set.source);
    const Batches batches(encoder, walk_step_mm, components);
    FibletBlock all;
    batches.prepare(all);
    std::uint64_t fibres = 0;
    model::FibreBatch batch, next;
    bool more = source->read(batch, kBatchPoints);
    while (more) {
        auto reading = std::async(std::launch::async, [&] { return source->read(next, kBatchPoints); });
        batches.encode(batch, all);
        addFibreColumns(batch, set);
        fibres += batch.fibreCount();
        more = reading.get();
        std::swap(batch, next);
        if (progress) progress(source->bytesTotal() > 0 ? double(source->bytesRead()) / double(source->bytesTotal()) : 0);
    }
    set.groups = source->groups();
    set.points = all.points;
    set.errors = {all.measured > 0 ? 1e3 * all.sum_error_mm / double(all.measured) : 0, 1e3 * all.max_error_mm, all.measured};
    const std::vector<std::uint32_t> order = arrangeFiblets(set, all.fiblets, all.heap, fibres);
    for (std::size_t c = 0; c < components.size(); ++c) {
        model::PointColumn column{
            header.vertex_columns[components[c].column].name, std::uint32_t(components[c].component), {}, {}};
        column.ranges.reserve(order.size());
        column.values.reserve(64 * order.size());
        for (const std::uint32_t i : order) {
            column.ranges.push_back(all.ranges[c][i]);
            column.values.insert(column.values.end(), all.values[c].begin() + 64L * i, all.values[c].begin() + 64L * (i + 1));
        }
        set.point_columns.push_back(std::move(column));
    }
    return set;
}

}  // namespace

model::FibletSet encodeFiblets(const OpenTractogram& open, const FibletOptions& options, const FibletProgress& progress) {
    if (!(options.bound_um > 0) || !(options.walk_bound_um > 0)) {
        throw Error(Code::kInvalidArgument, "the error bounds of fiblets are " + std::to_string(options.bound_um) + " and " +
                                                std::to_string(options.walk_bound_um) + " um; both would have to be above 0");
    }
    const auto part = [&](double begin, double end) {
        return FibletProgress([&progress, begin, end](double share) {
            if (progress) progress(begin + (end - begin) * share);
        });
    };
    const std::unique_ptr<model::TractogramSource> source = open();
    const FibletMeasures measures = measureTractogram(*source, part(0, 0.05));
    model::FibletSet set;
    set.source = source->header().source;
    set.bound_um = options.bound_um;
    const bool any = measures.all.points > 0;
    const glm::dvec3 low = any ? glm::dvec3(measures.all.bounds_min) : glm::dvec3(0),
                     high = any ? glm::dvec3(measures.all.bounds_max) : low;
    const glm::dvec3 size = high - low;
    set.origin_mm = low;
    set.codec.cell_mm = float(std::max(std::max({size.x, size.y, size.z}) / model::kFibletCellMax, 1e-6) * (1 + 1e-6));
    double kept = measures.keptStepMm(options.bound_um);
    if (measures.all.length_mm == 0 && measures.all.segments == 0) kept = 1;  // single points
    if (kept > 0 && (options.step_mm == 0 || options.step_mm == kept)) {
        set.codec.step_mm = float(kept);
        setCaps(measures.largest_turn, set.codec);
        return encodeAll(open, std::move(set), 0, options, part(0.05, 1));
    }
    const WalkChoice choice = chooseWalk(*open(), measures, options.step_mm, options.walk_bound_um, part(0.05, 0.3));
    set.walked = true;
    set.walk_errors = choice.errors;
    set.codec.step_mm = float(choice.step_mm);
    setCaps(measures.largest_turn, set.codec);
    return encodeAll(open, std::move(set), choice.step_mm, options, part(0.3, 1));
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
