#include "build/fiblet_batches.h"

#include <span>

#include "base/parallel.h"
#include "build/fiblet_walk.h"

namespace radiata {
namespace {

constexpr std::size_t kFibresPerBlock = 8;

}  // namespace

FibletBatches::FibletBatches(const FibletPlan& plan, const model::TractogramHeader& header, const FibletOptions& options)
    : encoder_(plan, options), walk_step_mm_(plan.walk_step_mm), header_(header) {
    for (std::size_t c = 0; c < header.vertex_columns.size(); ++c) {
        for (int k = 0; k < header.vertex_columns[c].components; ++k)
            components_.push_back({c, k, header.vertex_columns[c].components});
    }
}

void FibletBatches::encode(const model::FibreBatch& batch, std::size_t first, FibletBlock& all) const {
    const std::size_t count = batch.fibreCount() - first;
    std::vector<FibletBlock> blocks((count + kFibresPerBlock - 1) / kFibresPerBlock);
    parallelFor(count, kFibresPerBlock, [&](std::size_t begin, std::size_t end) {
        FibletBlock& block = blocks[begin / kFibresPerBlock];
        block = this->begin();
        Walk walked;
        std::vector<std::vector<float>> values(components_.size());
        for (std::size_t f = first + begin; f < first + end; ++f) {
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

FibletBlock FibletBatches::begin() const {
    FibletBlock block;
    block.ranges.resize(components_.size());
    block.values.resize(components_.size());
    return block;
}

std::vector<model::PointColumn> FibletBatches::columns() const {
    std::vector<model::PointColumn> columns;
    for (const Component& c : components_)
        columns.push_back({header_.vertex_columns[c.column].name, std::uint32_t(c.component), {}, {}});
    return columns;
}

float FibletBatches::value(const model::FibreBatch& batch, std::size_t f, std::size_t c, double place) const {
    const Component& from = components_[c];
    const float* first = batch.vertex_values[from.column].data() + batch.offsets[f] * from.of + from.component;
    const auto before = std::size_t(place);
    const double fraction = place - double(before);
    const float a = first[before * from.of];
    return fraction > 0 ? float(a + fraction * (double(first[(before + 1) * from.of]) - a)) : a;
}

}  // namespace radiata
