// Encoding of a tractogram batch by batch, when all that its fiblets share is settled. What comes out does not depend on how
// the fibres are divided into batches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "build/fiblet_block.h"
#include "build/fiblet_encode.h"
#include "model/tractogram.h"

namespace radiata {

class FibletBatches {
public:
    FibletBatches(const FibletPlan& plan, const model::TractogramHeader& header, const FibletOptions& options);

    /// Encodes the fibres from number `first` (of the batch) on and appends them, on all cores.
    void encode(const model::FibreBatch& batch, std::size_t first, FibletBlock& all) const;
    /// An empty block with this tractogram's point columns.
    FibletBlock begin() const;
    /// The point columns, without values.
    std::vector<model::PointColumn> columns() const;

private:
    /// One component of one vertex column.
    struct Component {
        std::size_t column = 0;
        int component = 0, of = 1;
    };
    float value(const model::FibreBatch& batch, std::size_t f, std::size_t c, double place) const;

    FibletEncoder encoder_;
    double walk_step_mm_;
    const model::TractogramHeader& header_;
    std::vector<Component> components_;
};

}  // namespace radiata
