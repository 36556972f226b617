// What a layer makes of each fibre: whether it is shown and stands out, and the number that colours it.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/buffer.h"
#include "model/fiblet_set.h"
#include "model/tractogram_layer.h"

namespace radiata::render {

/// FIBRE_SHOWN, FIBRE_HIDDEN or FIBRE_SELECTED for each fibre.
/// \throws Error(kInvalidArgument) for groups and fibres that the tractogram lacks, naming those it has
std::vector<std::uint8_t> fibreStates(const model::FibletSet& set, const model::TractogramLayer& layer);

/// What colours each fibre: values of the column, lengths, or places of groups, COLOUR_NO_VALUE where there is none; empty
/// where nothing of the kind does. \throws Error(kInvalidArgument) for a column that the tractogram lacks
std::vector<float> fibreValues(const model::FibletSet& set, const model::FibreColour& colour);

/// The two on the device, for as long as the layer's settings stay.
class FibreLook {
public:
    FibreLook(gpu::Device& device, const model::FibletSet& set, const model::TractogramLayer& layer);

    std::uint64_t stateAddress() const { return states_ ? states_.address() : 0; }  ///< 0: all fibres are shown
    std::uint64_t valueAddress() const { return values_ ? values_.address() : 0; }
    float valueMin() const { return value_min_; }  ///< over all fibres, finite; 0 and 0 without any
    float valueMax() const { return value_max_; }
    std::uint64_t shown() const { return shown_; }
    std::uint64_t selected() const { return selected_; }

private:
    gpu::Buffer states_, values_;
    float value_min_ = 0, value_max_ = 0;
    std::uint64_t shown_ = 0, selected_ = 0;
};

}  // namespace radiata::render
