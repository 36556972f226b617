#include "render/fiblet/fibre_filter.h"

#include <algorithm>
#include <limits>
#include <string>

#include "base/error.h"
#include "gpu/device.h"
#include "model/selection_text.h"
#include "render/fiblet/fibre_measures.h"
#include "shaders/shared/fiblet_draw.glsl"

namespace radiata::render {
namespace {

/// Whether each fibre passes the set's conditions.
std::vector<bool> passing(const model::FibletSet& set, const model::FibreSet& wanted, FibreSelector& selector) {
    const std::size_t count = set.fibres();
    std::vector<bool> passes(count, true);
    const auto keep = [&](const std::vector<bool>& listed) {
        for (std::size_t f = 0; f < count; ++f) passes[f] = passes[f] && listed[f];
    };
    if (!wanted.groups.empty()) {
        std::vector<bool> listed(count, false);
        for (const std::string& name : wanted.groups) {
            const auto group = std::ranges::find_if(set.groups, [&](const auto& each) { return each.name == name; });
            if (group == set.groups.end()) {
                throw Error(Code::kInvalidArgument, set.source + " has no group '" + name + "'; it has " + names(set.groups));
            }
            for (const std::uint32_t fibre : group->fibres) listed.at(fibre) = true;
        }
        keep(listed);
    }
    if (!wanted.fibres.empty()) {
        std::vector<bool> listed(count, false);
        for (const std::uint32_t fibre : wanted.fibres) {
            if (fibre >= count) {
                throw Error(Code::kInvalidArgument, set.source + " has no fibre " + std::to_string(fibre) + "; it has " +
                                                        std::to_string(count) + ", numbered from 0");
            }
            listed[fibre] = true;
        }
        keep(listed);
    }
    if (wanted.length_min_mm || wanted.length_max_mm) {
        const std::vector<float> lengths = fibreLengths(set);
        for (std::size_t f = 0; f < count; ++f) {
            passes[f] = passes[f] && lengths[f] >= wanted.length_min_mm.value_or(0) &&
                        lengths[f] <= wanted.length_max_mm.value_or(std::numeric_limits<float>::infinity());
        }
    }
    if (!wanted.selection.empty()) {
        const FibreBits bits = selector.select(model::parseSelection(wanted.selection));
        for (std::size_t f = 0; f < count; ++f) passes[f] = passes[f] && bits.test(f);
    }
    return passes;
}

/// The column of values per point, or null if there is none of this name.
const model::PointColumn* pointColumn(const model::FibletSet& set, const std::string& name) {
    const auto found =
        std::ranges::find_if(set.point_columns, [&](const auto& each) { return each.name == name && each.component == 0; });
    return found == set.point_columns.end() ? nullptr : &*found;
}

const model::FibreColumn* fibreColumn(const model::FibletSet& set, const std::string& name) {
    const auto found = std::ranges::find_if(set.fibre_columns, [&](const auto& each) { return each.name == name; });
    return found == set.fibre_columns.end() ? nullptr : &*found;
}

void checkCriteria(const model::FibletSet& set, const model::TractogramLayer& layer) {
    for (const model::FibreCriterion& criterion : layer.criteria) {
        if (fibreColumn(set, criterion.column) || pointColumn(set, criterion.column)) continue;
        throw Error(Code::kInvalidArgument, set.source + " has no column '" + criterion.column + "'; per fibre it has " +
                                                names(set.fibre_columns) + ", per point " + names(set.point_columns));
    }
}

}  // namespace

std::vector<std::uint8_t> fibreStates(const model::FibletSet& set, const model::TractogramLayer& layer,
                                      FibreSelector& selector) {
    std::vector<std::uint8_t> states(set.fibres(), shader::FIBRE_SHOWN);
    checkCriteria(set, layer);
    std::vector<bool> shown = passing(set, layer.shown, selector);
    for (const model::FibreCriterion& criterion : layer.criteria) {
        const model::FibreColumn* column = fibreColumn(set, criterion.column);
        for (std::size_t f = 0; column && f < states.size(); ++f) {
            const float value = column->values[f * column->components];
            shown[f] = shown[f] && value >= criterion.low && value <= criterion.high;
        }
    }
    std::vector<bool> selected;
    if (layer.selected) selected = passing(set, *layer.selected, selector);
    for (std::size_t f = 0; f < states.size(); ++f) {
        if (!shown[f]) {
            states[f] = shader::FIBRE_HIDDEN;
        } else if (!selected.empty() && selected[f]) {
            states[f] = shader::FIBRE_SELECTED;
        } else if (layer.selected && layer.unselected == model::UnselectedFibres::kHidden) {
            states[f] = shader::FIBRE_HIDDEN;
        }
    }
    return states;
}

SegmentMasks segmentMasks(const model::FibletSet& set, const model::TractogramLayer& layer, const FibreSelector& selector) {
    SegmentMasks masks;
    const auto all = [&] {
        if (masks.empty()) masks.assign(set.heads.size(), ~std::uint64_t{0});
    };
    for (const model::FibreRegionCut& cut : layer.region_cuts) {
        if (cut.by_depths) continue;
        all();
        keepByRegion(set, *selector.region(cut.region), cut.outside, masks);
    }
    checkCriteria(set, layer);
    for (const model::FibreCriterion& criterion : layer.criteria) {
        if (fibreColumn(set, criterion.column)) continue;
        all();
        keepByValues(set, *pointColumn(set, criterion.column), static_cast<double>(criterion.low),
                     static_cast<double>(criterion.high), masks);
    }
    return masks;
}

FibreFilter::FibreFilter(gpu::Device& device, const model::FibletSet& set, const model::TractogramLayer& layer,
                         FibreSelector& selector) {
    shown_ = set.fibres();
    if (!layer.shown.isAll() || layer.selected || !layer.criteria.empty()) {
        std::vector<std::uint8_t> states = fibreStates(set, layer, selector);
        selected_ = static_cast<std::uint64_t>(std::ranges::count(states, shader::FIBRE_SELECTED));
        shown_ -= static_cast<std::uint64_t>(std::ranges::count(states, shader::FIBRE_HIDDEN));
        states.resize((states.size() + 7) / 4 * 4);
        states_ = gpu::Buffer(device, states.size(), gpu::Memory::kDevice, "fibre states");
        gpu::upload(device, states_, 0, std::as_bytes(std::span(states)));
    }
    for (const model::FibreRegionCut& cut : layer.region_cuts) {
        if (cut.by_depths) keepTriangles(device, *selector.mesh(cut.region), set.origin_mm);
    }
    const SegmentMasks masks = segmentMasks(set, layer, selector);
    if (masks.empty()) return;
    segments_ = gpu::Buffer(device, std::span(masks).size_bytes(), gpu::Memory::kDevice, "shown segments");
    gpu::upload(device, segments_, 0, std::as_bytes(std::span(masks)));
}

void FibreFilter::keepTriangles(gpu::Device& device, const model::TriangleMesh& mesh, const glm::dvec3& origin_mm) {
    std::vector<glm::vec3> corners;
    double volume = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.points[t.x]), b(mesh.points[t.y]), c(mesh.points[t.z]);
        for (const glm::dvec3& p : {a, b, c}) corners.emplace_back(p - origin_mm);
        volume += glm::dot(a - origin_mm, glm::cross(b - origin_mm, c - origin_mm));
    }
    // A surface may be turned inside out: files do not agree on which side is which.
    for (std::size_t i = 0; volume < 0 && i < corners.size(); i += 3) std::swap(corners[i], corners[i + 1]);
    cut_triangle_count_ = static_cast<std::uint32_t>(mesh.triangles.size());
    cut_triangles_ = gpu::Buffer(device, std::span(corners).size_bytes(), gpu::Memory::kDevice, "cutting triangles");
    gpu::upload(device, cut_triangles_, 0, std::as_bytes(std::span(corners)));
}

}  // namespace radiata::render
