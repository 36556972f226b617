// What a layer makes of its fibres: the filter (who and what of them is shown), and what colours them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "build/distance_grid.h"
#include "gpu/buffer.h"
#include "model/fiblet_set.h"
#include "model/tractogram_layer.h"
#include "render/fiblet/fibre_filter.h"

namespace radiata::render {

/// What colours each fibre: values of the column, lengths, or places of groups, COLOUR_NO_VALUE where there is none; empty
/// where nothing of the kind does. \throws Error(kInvalidArgument) for a column that the tractogram lacks
std::vector<float> fibreValues(const model::FibletSet& set, const model::FibreColour& colour);

/// From each fibre's first to its last point as two times 16 bits (shaders/common/octahedral.glsl); 0 for a fibre without
/// length.
std::vector<std::uint32_t> fibreEnds(const model::FibletSet& set);

/// On the device, for as long as the layer's colour stays.
class FibreColours {
public:
    /// \throws as fibreValues(); as FibreSelector::region() and distanceGrid() for colours by distance
    FibreColours(gpu::Device& device, const model::FibletSet& set, const model::FibreColour& colour,
                 const FibreSelector& selector);

    std::uint64_t valueAddress() const { return values_ ? values_.address() : 0; }
    std::uint64_t rangeAddress() const { return ranges_ ? ranges_.address() : 0; }  ///< of values per point
    const DistanceGrid& grid() const { return grid_; }                              ///< without its values
    float valueMin() const { return value_min_; }  ///< over all that have a finite one; 0 and 0 without any
    float valueMax() const { return value_max_; }

private:
    void setFibres(gpu::Device& device, const std::vector<float>& values);
    void setPoints(gpu::Device& device, const model::FibletSet& set, const model::FibreColour& colour);
    void setDistances(gpu::Device& device, const model::FibletSet& set, const model::FibreColour& colour,
                      const FibreSelector& selector);
    template <typename Value>
    void upload(gpu::Device& device, const std::vector<Value>& values);

    gpu::Buffer values_, ranges_;
    DistanceGrid grid_;
    float value_min_ = 0, value_max_ = 0;
};

struct FibreLook {
    std::shared_ptr<const FibreFilter> filter;
    std::shared_ptr<const FibreColours> colours;

    std::uint64_t stateAddress() const { return filter->stateAddress(); }
    std::uint64_t segmentAddress() const { return filter->segmentAddress(); }
    std::uint64_t shown() const { return filter->shown(); }
};

}  // namespace radiata::render
