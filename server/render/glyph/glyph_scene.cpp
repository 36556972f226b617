#include "render/glyph/glyph_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "build/bvh.h"
#include "build/cylinder_box.h"
#include "build/glyph_instances.h"
#include "gpu/device.h"
#include "math/two_floats.h"
#include "shaders/shared/layer_look.glsl"

namespace radiata::render {
namespace {

/// Boxes of the traversal structures are in float scene coordinates; they grow by their rounding, so that none is missed.
constexpr float kBoxPadding = 4e-7F;
/// Amplitudes whose squares and products with bounds of derivatives float32 holds (tests/image/left_out_test.cpp). Lengths, mm.
constexpr float kAmplitudeMin = 1e-16F, kAmplitudeMax = 1e17F;
constexpr float kRadiusMin = 1e-20F, kRadiusMax = 1e18F;
constexpr float kLargestValue = 3e38F;  // below the mark of glyphs without a value

glm::dvec3 worldOf(const model::ShImage& image, std::uint32_t slot) {
    return glm::dvec3(image.voxel_to_world * glm::dvec4(glm::dvec3(image.voxels[slot]), 1.0));
}

/// Boxes, but not radii, become those around bounding cylinders if that is asked for. Ellipsoids have no bands and keep theirs.
GlyphSource withBoxes(GlyphSource source, const model::GlyphLayer& layer, model::GlyphBoxes boxes) {
    if (boxes == model::GlyphBoxes::kTight || !source.ellipsoids.empty()) return source;
    const model::ShImage& image = source.dataset->image();
    // A smaller layout of the same parity is a prefix.
    const ShLayout shown{bandLimit(layer, image), image.layout.full};
    const CylinderBoxes cylinders(shown);
    const std::span<const float> all(image.coefficients);
    for (std::size_t i = 0; i < source.slots.size(); ++i) {
        const auto glyph = all.subspan(source.slots[i] * image.layout.count(), shown.count());
        cylinders.box(glyph, source.bounds[i].min, source.bounds[i].max);
    }
    return source;
}

}  // namespace

plan::SceneBounds selectionBounds(const store::GlyphDataset& dataset, const model::VoxelSelection& selection) {
    const model::ShImage& image = dataset.image();
    const std::vector<std::uint32_t> slots = selectVoxels(image, selection);
    plan::SceneBounds bounds;
    if (slots.empty()) {
        datasetBounds(image, bounds.minimum, bounds.maximum);
        return bounds;
    }
    bounds.minimum = glm::dvec3(std::numeric_limits<double>::infinity());
    bounds.maximum = -bounds.minimum;
    glm::dvec3 half(0);
    for (int axis = 0; axis < 3; ++axis) half += 0.5 * glm::abs(glm::dvec3(image.voxel_to_world[axis]));
    for (const std::uint32_t slot : slots) {
        const glm::dvec3 centre = worldOf(image, slot);
        bounds.minimum = glm::min(bounds.minimum, centre - half);
        bounds.maximum = glm::max(bounds.maximum, centre + half);
    }
    return bounds;
}

GlyphScene::GlyphScene(gpu::Device& device, std::shared_ptr<const store::GlyphDataset> dataset, const model::GlyphLayer& layer,
                       const glm::dvec3& centre_mm, std::shared_ptr<const store::GlyphDataset> uncertainty,
                       model::GlyphBoxes boxes)
    : GlyphScene(device, withBoxes(shownGlyphs(device, dataset, layer), layer, boxes), layer, centre_mm) {
    boxes_ = boxes;
    if (uncertainty) {
        uncertain_.reset(new GlyphScene(device, uncertainGlyphs(device, dataset, uncertainty, layer), layer, centre_mm));
        if (!uncertain_->instances_.empty()) {
            bounds_.minimum = glm::min(bounds_.minimum, uncertain_->bounds_.minimum);
            bounds_.maximum = glm::max(bounds_.maximum, uncertain_->bounds_.maximum);
        }
    }
    catalogued_ = std::move(dataset);
    catalogued_uncertainty_ = std::move(uncertainty);
}

GlyphScene::GlyphScene(gpu::Device& device, const GlyphSource& source, const model::GlyphLayer& layer,
                       const glm::dvec3& centre_mm)
    : device_(device), dataset_(source.dataset), catalogued_(source.dataset), layer_(layer), centre_mm_(centre_mm) {
    makeInstances(source);
    const std::uint64_t bytes = std::max<std::uint64_t>(instances_.size(), 1) * sizeof(shader::GlyphInstance);
    instance_buffer_ = gpu::Buffer(device_, bytes, gpu::Memory::kDevice, "glyph instances");
    if (!instances_.empty()) gpu::upload(device_, instance_buffer_, 0, std::as_bytes(std::span(instances_)));
    if (!ellipsoids_.empty()) {
        ellipsoid_buffer_ = gpu::Buffer(device_, std::span(ellipsoids_).size_bytes(), gpu::Memory::kDevice, "ellipsoids");
        gpu::upload(device_, ellipsoid_buffer_, 0, std::as_bytes(std::span(ellipsoids_)));
    }
}

model::LeftOut GlyphScene::leftOut() const {
    const model::ShImage& image = catalogued_->image();
    // Ellipsoids have no bands to cut.
    const bool bands = layer_.tensor != model::TensorShape::kEllipsoid;
    const int lmax = bands ? bandLimit(layer_, image) : image.layout.lmax;
    return {0, lmax, image.layout.lmax, image.rejected_voxels, out_of_range_, without_lobes_};
}

std::uint64_t GlyphScene::tensorAddress() const {
    if (ellipsoid_buffer_) return ellipsoid_buffer_.address();
    return dataset_->tensors() ? dataset_->tensors().address() : 0;
}

void GlyphScene::makeInstances(const GlyphSource& source) {
    const std::vector<GlyphBounds>& boxes = source.bounds;
    bounds_.minimum = glm::dvec3(std::numeric_limits<double>::infinity());
    bounds_.maximum = -bounds_.minimum;
    instances_.reserve(source.slots.size());
    for (std::size_t i = 0; i < source.slots.size(); ++i) {
        const auto mm = static_cast<float>(source.scales[i]);
        // Glyphs without a visible lobe, or too small or large for float, have nothing to hit.
        const auto within = [](float value, float low, float high) { return value > low && value < high; };
        // Ellipsoids are met in the space where they are the unit sphere, whatever their amplitude.
        const bool held = within(boxes[i].radius * mm, kRadiusMin, kRadiusMax) && std::isnormal(mm) &&
                          (!source.ellipsoids.empty() || within(boxes[i].amplitude_max, kAmplitudeMin, kAmplitudeMax));
        if (!held) {
            ++(boxes[i].radius == 0 ? without_lobes_ : out_of_range_);
            continue;
        }
        const glm::dvec3 world = worldOf(dataset_->image(), source.slots[i]);
        const glm::dvec3 relative = world - centre_mm_;
        shader::GlyphInstance glyph{};
        const TwoFloats centre = twoFloats(relative);
        glyph.centre_high = centre.high;
        glyph.centre_low = centre.low;
        glyph.scale = mm;
        glyph.radius = boxes[i].radius * mm;
        glyph.box_min = boxes[i].min * mm;
        glyph.box_max = boxes[i].max * mm;
        glyph.slot = source.slots[i];
        instances_.push_back(glyph);
        if (!source.ellipsoids.empty()) ellipsoids_.push_back(source.ellipsoids[i]);
        largest_radius_ = std::max(largest_radius_, glyph.radius);
        bounds_.minimum = glm::min(bounds_.minimum, world + glm::dvec3(glyph.box_min));
        bounds_.maximum = glm::max(bounds_.maximum, world + glm::dvec3(glyph.box_max));
    }
    if (instances_.empty()) bounds_.minimum = bounds_.maximum = centre_mm_;
}

const gpu::BoxAcceleration& GlyphScene::acceleration() {
    if (!acceleration_ && !instances_.empty()) {
        std::vector<gpu::Aabb> boxes(instances_.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const shader::GlyphInstance& glyph = instances_[i];
            const glm::vec3 pad = kBoxPadding * (glm::abs(glyph.centre_high) + glyph.radius);
            const glm::vec3 low = glyph.centre_high + glyph.box_min - pad, high = glyph.centre_high + glyph.box_max + pad;
            boxes[i] = {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
        }
        acceleration_ = gpu::BoxAcceleration(device_, boxes);
    }
    return acceleration_;
}

void GlyphScene::buildHierarchy() {
    std::vector<glm::vec3> lows(instances_.size()), highs(instances_.size());
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        const shader::GlyphInstance& glyph = instances_[i];
        const glm::vec3 pad = kBoxPadding * (glm::abs(glyph.centre_high) + glyph.radius);
        lows[i] = glyph.centre_high + glyph.box_min - pad;
        highs[i] = glyph.centre_high + glyph.box_max + pad;
    }
    const Bvh bvh = buildBvh(lows, highs);
    bvh_nodes_ = gpu::Buffer(device_, std::span(bvh.nodes).size_bytes(), gpu::Memory::kDevice, "glyph hierarchy");
    bvh_order_ = gpu::Buffer(device_, std::max<std::size_t>(bvh.order.size(), 1) * 4, gpu::Memory::kDevice, "glyph order");
    gpu::upload(device_, bvh_nodes_, 0, std::as_bytes(std::span(bvh.nodes)));
    if (!bvh.order.empty()) gpu::upload(device_, bvh_order_, 0, std::as_bytes(std::span(bvh.order)));
}

const gpu::Buffer& GlyphScene::bvhNodes() {
    if (!bvh_nodes_) buildHierarchy();
    return bvh_nodes_;
}

const gpu::Buffer& GlyphScene::bvhOrder() {
    if (!bvh_order_) buildHierarchy();
    return bvh_order_;
}

const gpu::Buffer& GlyphScene::values(const std::shared_ptr<const store::ScalarDataset>& scalars) {
    if (values_of_ == scalars) return values_;
    const glm::dmat4 map = store::voxelMap(*scalars, dataset_->info());
    std::vector<float> values(std::max<std::size_t>(instances_.size(), 1), shader::COLOUR_NO_VALUE);
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        const glm::dvec3 voxel(map * glm::dvec4(glm::dvec3(dataset_->image().voxels[instances_[i].slot]), 1.0));
        const float value = scalars->image().at(glm::ivec3(glm::round(voxel)));
        values[i] = std::isfinite(value) ? std::min(value, kLargestValue) : shader::COLOUR_NO_VALUE;
    }
    values_of_.reset();  // so that a failure leaves nothing half done
    values_ = gpu::Buffer();
    values_ = gpu::Buffer(device_, std::span(values).size_bytes(), gpu::Memory::kDevice, "glyph values");
    gpu::upload(device_, values_, 0, std::as_bytes(std::span(values)));
    values_of_ = scalars;
    return values_;
}

double GlyphScene::depthAlong(const glm::dvec3& direction) const {
    // A box's outline across a direction has the area of its faces weighted by the direction's cosines.
    const glm::dvec3 cosines = glm::abs(direction);
    const auto outline = [&cosines](const glm::dvec3& size) {
        return glm::dot(cosines, glm::dvec3(size.y * size.z, size.z * size.x, size.x * size.y));
    };
    double area = 0;
    for (const shader::GlyphInstance& glyph : instances_) area += outline(glm::dvec3(glyph.box_max - glyph.box_min));
    return area / std::max(outline(bounds_.maximum - bounds_.minimum), 1e-30);
}

plan::LayerFacts GlyphScene::facts(const plan::RebasedCamera& camera, int width, int height) const {
    plan::LayerFacts facts;
    facts.layout = dataset_->image().layout;
    facts.tensor_order = catalogued_->image().tensor_order;
    facts.odd_bands_only = dataset_->oddBandsOnly();
    facts.glyphs = instances_.size();
    const double typical = catalogued_->info().amplitude_typical;
    facts.radius_typical_mm = layer_.scale.mode == model::ScaleMode::kAbsolute
                                  ? layer_.scale.factor * typical
                                  : layer_.scale.factor * halfVoxel(dataset_->image());
    facts.voxel_edge_mm = 2 * halfVoxel(dataset_->image());
    facts.glyphs_available = catalogued_->image().voxels.size();
    if (uncertain_) facts.uncertainty = {uncertain_->facts(camera, width, height)};
    if (instances_.empty()) return facts;
    const shader::CameraRays& rays = camera.rays;
    const glm::vec3 right = rays.step_right / glm::dot(rays.step_right, rays.step_right);
    const glm::vec3 up = rays.step_up / glm::dot(rays.step_up, rays.step_up);
    const glm::vec3 eye = rays.inverse_distance > 0 ? -rays.forward / rays.inverse_distance : glm::vec3(0);
    // Box areas in pixels over a sample of the glyphs that project into the picture.
    double area = 0;
    std::size_t sampled = 0;
    const std::size_t stride = std::max<std::size_t>(1, instances_.size() / 4096);
    const glm::vec2 half_picture(0.5F * static_cast<float>(width), 0.5F * static_cast<float>(height));
    for (std::size_t i = 0; i < instances_.size(); i += stride, ++sampled) {
        const shader::GlyphInstance& glyph = instances_[i];
        const glm::vec3 centre = (glyph.centre_high - rays.reference_high) + (glyph.centre_low - rays.reference_low);
        const float nearness = 1 + glm::dot(centre, rays.forward) * rays.inverse_distance;
        if (nearness < 1e-4F) continue;
        const glm::vec3 half = 0.5F * (glyph.box_max - glyph.box_min);
        const glm::vec2 at(glm::dot(centre, right) / nearness, glm::dot(centre, up) / nearness);
        const glm::vec2 size(glm::dot(half, glm::abs(right)) / nearness, glm::dot(half, glm::abs(up)) / nearness);
        if (glm::any(glm::greaterThan(glm::abs(at), half_picture + size))) continue;
        const glm::vec2 cut = glm::min(2.0F * size, 2.0F * half_picture);
        area += static_cast<double>(cut.x) * static_cast<double>(cut.y);
    }
    // Close: within twice the largest radius of any glyph's centre; an exact test, as the table must never be used there.
    if (rays.inverse_distance > 0) {
        for (const shader::GlyphInstance& glyph : instances_) {
            const glm::vec3 centre = (glyph.centre_high - rays.reference_high) + (glyph.centre_low - rays.reference_low);
            if (glm::length(centre - eye) < 2 * glyph.radius) {
                facts.camera_close = true;
                break;
            }
        }
    }
    const double share = static_cast<double>(instances_.size()) / static_cast<double>(sampled);
    const double pixels = static_cast<double>(width) * height;
    facts.rays_per_glyph = std::min(area * share, pixels * 64) / static_cast<double>(instances_.size());
    // Where the layer covers only part of the picture its boxes are as deep as its own outline is filled.
    const glm::dvec3 extent = bounds_.maximum - bounds_.minimum;
    const glm::dvec3 half = 0.5 * extent;
    const double outline_x = std::min<double>(2 * glm::dot(half, glm::abs(glm::dvec3(right))), width);
    const double outline_y = std::min<double>(2 * glm::dot(half, glm::abs(glm::dvec3(up))), height);
    facts.depth_complexity = area * share / std::max(1.0, outline_x * outline_y);
    return facts;
}

}  // namespace radiata::render
