// One glyph layer as it stands on the device: instances, boxes and traversal structures, kept until the layer's settings
// change.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "gpu/acceleration.h"
#include "gpu/buffer.h"
#include "model/intersection.h"
#include "model/left_out.h"
#include "model/scene.h"
#include "plan/camera_rays.h"
#include "plan/plan.h"
#include "render/glyph/glyph_source.h"
#include "shaders/shared/glyph.glsl"
#include "store/glyph_dataset.h"
#include "store/scalar_dataset.h"

namespace radiata::render {

/// Everything about a layer that does not depend on the camera. Boxes are relative to `centre_mm`.
class GlyphScene {
public:
    /// \param uncertainty  the dataset that layer.uncertainty names; null: none
    /// \throws Error(kInvalidArgument, kResourceExhausted)
    GlyphScene(gpu::Device& device, std::shared_ptr<const store::GlyphDataset> dataset, const model::GlyphLayer& layer,
               const glm::dvec3& centre_mm, std::shared_ptr<const store::GlyphDataset> uncertainty = nullptr,
               model::GlyphBoxes boxes = model::GlyphBoxes::kTight);

    /// What is drawn, which may be a copy made for this layer.
    const store::GlyphDataset& dataset() const { return *dataset_; }
    /// What the layer names.
    const store::GlyphDataset& catalogued() const { return *catalogued_; }
    const store::GlyphDataset* cataloguedUncertainty() const { return catalogued_uncertainty_.get(); }
    /// The second glyphs of a layer with uncertainty; null: none.
    GlyphScene* uncertain() const { return uncertain_.get(); }
    const model::GlyphLayer& layer() const { return layer_; }
    const glm::dvec3& centreMm() const { return centre_mm_; }
    model::GlyphBoxes boxes() const { return boxes_; }
    const std::vector<shader::GlyphInstance>& instances() const { return instances_; }
    /// What of the layer is not drawn, but for the layer's number.
    model::LeftOut leftOut() const;
    const gpu::Buffer& instanceBuffer() const { return instance_buffer_; }
    const plan::SceneBounds& bounds() const { return bounds_; }

    /// What layer.tensors of the shaders points to: the components of each slot, or of ellipsoids D^-1 of each instance; 0
    /// where there are no tensors.
    std::uint64_t tensorAddress() const;

    /// Built when first wanted: a frame by tile lists needs neither.
    const gpu::BoxAcceleration& acceleration();
    const gpu::Buffer& bvhNodes();
    const gpu::Buffer& bvhOrder();

    /// float[instances]: values of a volume at the glyphs' voxels, COLOUR_NO_VALUE where one is not finite. That of the volume
    /// asked for last is kept. \throws as store::voxelMap()
    const gpu::Buffer& values(const std::shared_ptr<const store::ScalarDataset>& scalars);

    /// Glyph boxes along a ray in this direction, estimated over the layer's outline. \param direction  unit, world
    double depthAlong(const glm::dvec3& direction) const;
    plan::LayerFacts facts(const plan::RebasedCamera& camera, int width, int height) const;

private:
    GlyphScene(gpu::Device& device, const GlyphSource& source, const model::GlyphLayer& layer, const glm::dvec3& centre_mm);
    void makeInstances(const GlyphSource& source);
    void buildHierarchy();

    gpu::Device& device_;
    std::shared_ptr<const store::GlyphDataset> dataset_, catalogued_, catalogued_uncertainty_;
    std::unique_ptr<GlyphScene> uncertain_;
    model::GlyphLayer layer_;
    glm::dvec3 centre_mm_;
    model::GlyphBoxes boxes_ = model::GlyphBoxes::kTight;
    std::vector<shader::GlyphInstance> instances_;
    std::uint64_t out_of_range_ = 0, without_lobes_ = 0;  ///< selected glyphs that are no instances
    plan::SceneBounds bounds_;                            ///< world
    float largest_radius_ = 0;
    std::vector<std::array<float, 6>> ellipsoids_;  ///< by instance
    gpu::Buffer ellipsoid_buffer_;
    gpu::Buffer instance_buffer_, bvh_nodes_, bvh_order_;
    gpu::BoxAcceleration acceleration_;
    std::shared_ptr<const store::ScalarDataset> values_of_;
    gpu::Buffer values_;
};

/// World bounds of what a layer's selection can cover, before any glyph is scaled: its voxels, grown by one voxel.
plan::SceneBounds selectionBounds(const store::GlyphDataset& dataset, const model::VoxelSelection& selection);

}  // namespace radiata::render
