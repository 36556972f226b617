// Which fibres of a layer are shown and stand out, and which of their segments are shown, on the device for as long as the
// layer's settings stay.
#pragma once

#include <cstdint>
#include <vector>

#include "build/fibre_selection.h"
#include "build/segment_masks.h"
#include "gpu/buffer.h"
#include "model/fiblet_set.h"
#include "model/tractogram_layer.h"

namespace radiata::render {

/// FIBRE_SHOWN, FIBRE_HIDDEN or FIBRE_SELECTED for each fibre.
/// \throws Error(kInvalidArgument) for groups, fibres and columns that the tractogram lacks, naming those it has; Error as
///         FibreSelector::select()
std::vector<std::uint8_t> fibreStates(const model::FibletSet& set, const model::TractogramLayer& layer,
                                      FibreSelector& selector);

/// Segments within the layer's region cuts and criteria on values per point; empty without any: all are shown.
/// \throws as fibreStates(), and as FibreSelector::region()
SegmentMasks segmentMasks(const model::FibletSet& set, const model::TractogramLayer& layer, const FibreSelector& selector);

class FibreFilter {
public:
    FibreFilter(gpu::Device& device, const model::FibletSet& set, const model::TractogramLayer& layer, FibreSelector& selector);

    std::uint64_t stateAddress() const { return states_ ? states_.address() : 0; }        ///< 0: all fibres are shown
    std::uint64_t segmentAddress() const { return segments_ ? segments_.address() : 0; }  ///< 0: all segments are
    /// Of the mesh that cuts by depths: vec3[3 * count], mm from the fiblets' origin, counter-clockwise seen from outside.
    std::uint64_t cutTriangles() const { return cut_triangles_ ? cut_triangles_.address() : 0; }
    std::uint32_t cutTriangleCount() const { return cut_triangle_count_; }
    std::uint64_t shown() const { return shown_; }  ///< fibres
    std::uint64_t selected() const { return selected_; }

private:
    void keepTriangles(gpu::Device& device, const model::TriangleMesh& mesh, const glm::dvec3& origin_mm);

    gpu::Buffer states_, segments_, cut_triangles_;
    std::uint32_t cut_triangle_count_ = 0;
    std::uint64_t shown_ = 0, selected_ = 0;
};

}  // namespace radiata::render
