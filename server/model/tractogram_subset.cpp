#include "model/tractogram_subset.h"

#include <algorithm>

namespace radiata::model {
namespace {

class Subset : public TractogramSource {
public:
    Subset(std::unique_ptr<TractogramSource> source, std::vector<std::uint32_t> fibres)
        : source_(std::move(source)), fibres_(std::move(fibres)), header_(source_->header()) {
        header_.fibre_count = fibres_.size();
        header_.point_count.reset();
    }

    const TractogramHeader& header() const override { return header_; }

    bool read(FibreBatch& batch, std::size_t points_wanted) override {
        batch.clear(header_.vertex_columns.size(), header_.fibre_columns.size());
        batch.first_fibre = next_;
        batch.first_point = points_;
        // All is read to the end, so that files that are cut off are told.
        while (batch.fibreCount() == 0 && source_->read(all_, points_wanted)) take(batch);
        points_ += batch.points.size();
        return batch.fibreCount() > 0;
    }

    std::vector<FibreGroup> groups() override {
        std::vector<FibreGroup> kept;
        for (FibreGroup& group : source_->groups()) {
            std::vector<std::uint32_t> members;
            for (const std::uint32_t fibre : group.fibres) {
                const auto at = std::lower_bound(fibres_.begin(), fibres_.end(), fibre);
                if (at != fibres_.end() && *at == fibre) members.push_back(static_cast<std::uint32_t>(at - fibres_.begin()));
            }
            if (members.empty()) continue;
            group.fibres = std::move(members);
            kept.push_back(std::move(group));
        }
        return kept;
    }

    std::uint64_t damagedFibres() const override { return source_->damagedFibres(); }
    std::uint64_t bytesRead() const override { return source_->bytesRead(); }
    std::uint64_t bytesTotal() const override { return source_->bytesTotal(); }

private:
    void take(FibreBatch& batch) {
        const std::uint64_t end = all_.first_fibre + all_.fibreCount();
        for (; next_ < fibres_.size() && fibres_[next_] < end; ++next_) {
            const std::uint64_t f = fibres_[next_] - all_.first_fibre;
            const std::uint64_t first = all_.offsets[f], last = all_.offsets[f + 1];
            copy(all_.points, first, last, batch.points);
            batch.offsets.push_back(batch.points.size());
            for (std::size_t c = 0; c < batch.vertex_values.size(); ++c) {
                const auto n = static_cast<std::uint64_t>(header_.vertex_columns[c].components);
                copy(all_.vertex_values[c], first * n, last * n, batch.vertex_values[c]);
            }
            for (std::size_t c = 0; c < batch.fibre_values.size(); ++c) {
                const auto n = static_cast<std::uint64_t>(header_.fibre_columns[c].components);
                copy(all_.fibre_values[c], f * n, (f + 1) * n, batch.fibre_values[c]);
            }
        }
    }

    template <typename T>
    static void copy(const std::vector<T>& from, std::uint64_t first, std::uint64_t last, std::vector<T>& to) {
        to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(first),
                  from.begin() + static_cast<std::ptrdiff_t>(last));
    }

    std::unique_ptr<TractogramSource> source_;
    std::vector<std::uint32_t> fibres_;
    TractogramHeader header_;
    FibreBatch all_;
    std::size_t next_ = 0;
    std::uint64_t points_ = 0;
};

}  // namespace

std::unique_ptr<TractogramSource> subsetOf(std::unique_ptr<TractogramSource> source, std::vector<std::uint32_t> fibres) {
    return std::make_unique<Subset>(std::move(source), std::move(fibres));
}

}  // namespace radiata::model
