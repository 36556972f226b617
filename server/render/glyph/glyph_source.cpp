#include "render/glyph/glyph_source.h"

#include <algorithm>
#include <numeric>

#include "build/ellipsoid.h"
#include "build/glyph_instances.h"
#include "build/isotropic_part.h"
#include "build/uncertain_glyphs.h"
#include "gpu/device.h"

namespace radiata::render {
namespace {

bool bothLobes(const model::GlyphLayer& layer) { return layer.negative_lobes == model::NegativeLobes::kShown; }

std::vector<std::uint32_t> allSlots(const store::GlyphDataset& dataset) {
    std::vector<std::uint32_t> slots(dataset.image().voxels.size());
    std::iota(slots.begin(), slots.end(), 0U);
    return slots;
}

/// mm per unit of amplitude of the glyphs in these slots.
std::vector<double> scalesOf(const store::GlyphDataset& dataset, const model::GlyphLayer& layer,
                             const std::vector<GlyphBounds>& bounds) {
    const double factor = layer.scale.factor;
    std::vector<double> scales(bounds.size(), factor);
    if (layer.scale.mode == model::ScaleMode::kAbsolute) return scales;
    const double half_voxel = halfVoxel(dataset.image());
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        const double largest =
            layer.scale.mode == model::ScaleMode::kGlobal ? dataset.info().amplitude_typical : bounds[i].amplitude_max;
        scales[i] = largest > 0 ? factor * half_voxel / largest : 0;
    }
    return scales;
}

/// The boxes of ellipsoids in place of those of the Reynolds glyphs.
void boundEllipsoids(const model::ShImage& image, GlyphSource& source) {
    source.bounds.assign(source.slots.size(), {});
    if (image.tensor_order != 2) return;  // the plan refuses such a layer
    for (std::size_t i = 0; i < source.slots.size(); ++i) {
        const Ellipsoid ellipsoid = ellipsoidOf(std::span(image.tensors).subspan(std::size_t{source.slots[i]} * 6, 6));
        source.bounds[i] = {-ellipsoid.extent, ellipsoid.extent, ellipsoid.radius, ellipsoid.longest};
        source.ellipsoids.push_back(ellipsoid.inverse);
    }
}

/// The layer's glyphs as the dataset has them.
GlyphSource cataloguedGlyphs(const std::shared_ptr<const store::GlyphDataset>& dataset, const model::GlyphLayer& layer) {
    const model::ShImage& image = dataset->image();
    GlyphSource source;
    source.dataset = dataset;
    source.slots = selectVoxels(image, layer.selection);
    if (layer.tensor == model::TensorShape::kEllipsoid) {
        boundEllipsoids(image, source);
    } else {
        source.bounds = dataset->bounds(source.slots, bandLimit(layer, image), bothLobes(layer));
    }
    source.scales = scalesOf(*dataset, layer, source.bounds);
    return source;
}

/// A dataset for one layer alone, from glyphs that are all drawn.
std::shared_ptr<const store::GlyphDataset> derived(gpu::Device& device, const std::string& id, model::ShImage image) {
    return std::make_shared<const store::GlyphDataset>(device, id, std::move(image));
}

}  // namespace

int bandLimit(const model::GlyphLayer& layer, const model::ShImage& image) {
    const int lmax = std::min(layer.lmax.value_or(image.layout.lmax), image.layout.lmax);
    return image.layout.full ? lmax : lmax - lmax % 2;
}

GlyphSource shownGlyphs(gpu::Device& device, const std::shared_ptr<const store::GlyphDataset>& dataset,
                        const model::GlyphLayer& layer) {
    GlyphSource source = cataloguedGlyphs(dataset, layer);
    if (layer.isotropic_part > 0) {
        const double amplitude = static_cast<double>(layer.isotropic_part) * dataset->info().amplitude_typical;
        source.dataset = derived(device, dataset->info().id + " with isotropic part",
                                 withIsotropicPart(dataset->image(), source.slots, amplitude));
        source.slots = allSlots(*source.dataset);
        source.bounds = source.dataset->bounds(source.slots, bandLimit(layer, dataset->image()), bothLobes(layer));
    }
    return source;
}

GlyphSource uncertainGlyphs(gpu::Device& device, const std::shared_ptr<const store::GlyphDataset>& dataset,
                            const std::shared_ptr<const store::GlyphDataset>& uncertainty, const model::GlyphLayer& layer) {
    const model::ShImage& image = dataset->image();
    const GlyphSource first = cataloguedGlyphs(dataset, layer);
    GlyphSource source;
    source.scales = first.scales;
    if (layer.uncertainty->kind == model::UncertaintyKind::kDeviations) {
        source.dataset = derived(
            device, uncertainty->info().id + " about " + dataset->info().id,
            outerGlyphs(image, first.slots, uncertainty->image(), layer.uncertainty->deviations, bandLimit(layer, image)));
        source.slots = allSlots(*source.dataset);
    } else {
        checkSameGrid(image, uncertainty->image());
        source.dataset = uncertainty;
        source.scales.clear();
        const std::vector<std::uint32_t> second = matchVoxels(image, first.slots, uncertainty->image());
        for (std::size_t i = 0; i < second.size(); ++i) {
            if (second[i] == kNoVoxel) continue;
            source.slots.push_back(second[i]);
            source.scales.push_back(first.scales[i]);
        }
    }
    if (layer.isotropic_part > 0) {
        const double amplitude = static_cast<double>(layer.isotropic_part) * dataset->info().amplitude_typical;
        source.dataset = derived(device, uncertainty->info().id + " with isotropic part",
                                 withIsotropicPart(source.dataset->image(), source.slots, amplitude));
        source.slots = allSlots(*source.dataset);
    }
    // Bands above the layer's are left out, whether it says so or has no more.
    model::GlyphLayer limited = layer;
    limited.lmax = layer.lmax.value_or(image.layout.lmax);
    source.bounds = source.dataset->bounds(source.slots, bandLimit(limited, source.dataset->image()), bothLobes(layer));
    return source;
}

}  // namespace radiata::render
