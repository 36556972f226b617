#include "build/fiblet_source.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "build/fiblet_code.h"

namespace radiata {
namespace {

/// Of one point, or NaN for none.
float valueOf(const model::PointColumn& column, std::uint32_t fiblet, std::uint32_t point) {
    const std::uint8_t stored = column.values[64UL * fiblet + point];
    if (stored == 255) return std::numeric_limits<float>::quiet_NaN();
    const glm::vec2 range = column.ranges[fiblet];
    return range.x + (range.y - range.x) * (float(stored) / 254.0F);
}

class FibletSource : public model::TractogramSource {
public:
    explicit FibletSource(const model::FibletSet& set) : set_(set) {
        header_.source = set.source;
        header_.format = "fiblet";
        header_.fibre_count = set.fibres();
        header_.point_count = set.points;
        header_.remarks = set.remarks;
        for (const model::FibreColumn& column : set.fibre_columns)
            header_.fibre_columns.push_back({column.name, int(column.components)});
        for (const model::PointColumn& column : set.point_columns) {
            if (column.component == 0) header_.vertex_columns.push_back({column.name, 0});
            if (!header_.vertex_columns.empty()) ++header_.vertex_columns.back().components;
        }
    }

    const model::TractogramHeader& header() const override { return header_; }

    bool read(model::FibreBatch& batch, std::size_t points_wanted) override {
        batch.clear(header_.vertex_columns.size(), header_.fibre_columns.size());
        batch.first_fibre = fibre_;
        batch.first_point = point_;
        while (fibre_ < set_.fibres() && batch.points.size() < points_wanted) addFibre(batch);
        point_ += batch.points.size();
        return batch.fibreCount() > 0;
    }

    std::vector<model::FibreGroup> groups() override { return set_.groups; }
    std::uint64_t bytesRead() const override { return point_; }
    std::uint64_t bytesTotal() const override { return set_.points; }

private:
    void addFibre(model::FibreBatch& batch) {
        for (const glm::dvec3& p : decodeFibre(set_, fibre_)) batch.points.emplace_back(p);
        batch.offsets.push_back(batch.points.size());
        std::size_t next = 0;
        for (std::size_t c = 0; c < header_.vertex_columns.size(); ++c) {
            const auto components = std::size_t(header_.vertex_columns[c].components);
            addValues(next, components, batch.vertex_values[c]);
            next += components;
        }
        for (std::size_t c = 0; c < set_.fibre_columns.size(); ++c) {
            const model::FibreColumn& column = set_.fibre_columns[c];
            const auto first = column.values.begin() + std::ptrdiff_t(fibre_ * column.components);
            batch.fibre_values[c].insert(batch.fibre_values[c].end(), first, first + column.components);
        }
        ++fibre_;
    }

    void addValues(std::size_t first_column, std::size_t components, std::vector<float>& values) const {
        for (std::uint32_t i = set_.fibre_first[fibre_]; i < set_.fibre_first[fibre_ + 1]; ++i) {
            const std::uint32_t fiblet = set_.fibre_fiblets[i];
            const model::FibletHead& head = set_.heads[fiblet];
            const std::uint32_t count = model::fibletSegments(head) + (model::fibletIsLast(head) ? 1 : 0);
            for (std::uint32_t k = 0; k < count; ++k) {
                for (std::size_t c = 0; c < components; ++c)
                    values.push_back(valueOf(set_.point_columns[first_column + c], fiblet, k));
            }
        }
    }

    const model::FibletSet& set_;
    model::TractogramHeader header_;
    std::uint64_t fibre_ = 0, point_ = 0;
};

}  // namespace

std::unique_ptr<model::TractogramSource> sourceOf(const model::FibletSet& set) { return std::make_unique<FibletSource>(set); }

}  // namespace radiata
