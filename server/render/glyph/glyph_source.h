// Which functions a layer's glyphs are drawn from, in which voxels and how large: the step between datasets and instances.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "build/bounds.h"
#include "gpu/fwd.h"
#include "model/scene.h"
#include "store/glyph_dataset.h"

namespace radiata::render {

/// Glyphs to be placed; vectors have one entry for each of them.
struct GlyphSource {
    /// Holds the drawn coefficients: a dataset of the catalogue, or one made from it for this layer alone.
    std::shared_ptr<const store::GlyphDataset> dataset;
    std::vector<std::uint32_t> slots;  ///< of that dataset
    std::vector<GlyphBounds> bounds;   ///< units of amplitude
    std::vector<double> scales;        ///< mm per unit of amplitude
    /// Ellipsoids only: D^-1 of each, as shaders read it.
    std::vector<std::array<float, 6>> ellipsoids;
};

/// The band limit of a layer within an image's bands.
int bandLimit(const model::GlyphLayer& layer, const model::ShImage& image);

/// The layer's glyphs. An isotropic part is added to a copy of the selected glyphs; without one nothing is copied.
GlyphSource shownGlyphs(gpu::Device& device, const std::shared_ptr<const store::GlyphDataset>& dataset,
                        const model::GlyphLayer& layer);

/// The second glyphs of layer.uncertainty, at the scales of the first. \param uncertainty  the dataset that it names
/// \throws Error(kInvalidArgument) naming both images if they do not fit; see build/uncertain_glyphs.h
GlyphSource uncertainGlyphs(gpu::Device& device, const std::shared_ptr<const store::GlyphDataset>& dataset,
                            const std::shared_ptr<const store::GlyphDataset>& uncertainty, const model::GlyphLayer& layer);

}  // namespace radiata::render
