#include "io/fibre_builder.h"

#include "base/error.h"

namespace radiata::io {

void FibreBuilder::begin(model::FibreBatch& batch) {
    batch_ = &batch;
    batch.clear(header_.vertex_columns.size(), header_.fibre_columns.size());
    batch.first_fibre = fibres_;
    batch.first_point = points_;
}

void FibreBuilder::addPoints(std::span<const glm::vec3> points) {
    if (pending() + points.size() > kFibrePointsMax) {
        throw Error(Code::kResourceExhausted, header_.source + ": fibre " + std::to_string(fibres_) + " has more than " +
                                                  std::to_string(kFibrePointsMax) + " points; separators seem to be missing");
    }
    batch_->points.insert(batch_->points.end(), points.begin(), points.end());
}

void FibreBuilder::endFibre(std::span<const float> fibre_values) {
    if (fibres_ == model::kFibreCountMax) {
        throw Error(Code::kResourceExhausted, header_.source + ": holds more than " + std::to_string(model::kFibreCountMax) +
                                                  " fibres, which cannot be numbered with 32 bits");
    }
    if (damaged_now_) {
        ++damaged_;
        damaged_now_ = false;
        const std::uint64_t keep = batch_->offsets.back();
        batch_->points.resize(keep);
        for (std::size_t c = 0; c < batch_->vertex_values.size(); ++c) {
            batch_->vertex_values[c].resize(keep * static_cast<std::uint64_t>(header_.vertex_columns[c].components));
        }
    }
    points_ += pending();
    ++fibres_;
    batch_->offsets.push_back(batch_->points.size());
    std::size_t next = 0;
    for (std::size_t c = 0; c < header_.fibre_columns.size() && next < fibre_values.size(); ++c) {
        const auto n = static_cast<std::size_t>(header_.fibre_columns[c].components);
        const std::span<const float> own = fibre_values.subspan(next, n);
        batch_->fibre_values[c].insert(batch_->fibre_values[c].end(), own.begin(), own.end());
        next += n;
    }
}

}  // namespace radiata::io
