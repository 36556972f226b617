#include "render/fiblet/fibre_look.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <glm/gtc/packing.hpp>

#include "base/error.h"
#include "gpu/device.h"
#include "render/fiblet/fibre_measures.h"
#include "shaders/shared/fiblet_draw.glsl"
#include "shaders/shared/layer_look.glsl"

namespace radiata::render {
namespace {

/// Twice 16 bits, as octahedralOf() and packSnorm2x16() of the shaders. \param v  any length but zero
std::uint32_t packedDirection(const glm::dvec3& v) {
    const double sum = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
    glm::dvec2 p(v.x / sum, v.y / sum);
    if (v.z < 0) {
        const glm::dvec2 q(1 - std::abs(p.y), 1 - std::abs(p.x));
        p = {p.x >= 0 ? q.x : -q.x, p.y >= 0 ? q.y : -q.y};
    }
    return glm::packSnorm2x16(glm::vec2(p));
}

}  // namespace

std::vector<float> fibreValues(const model::FibletSet& set, const model::FibreColour& colour) {
    if (colour.mode == model::FibreColourMode::kLength) return fibreLengths(set);
    std::vector<float> values;
    if (colour.mode == model::FibreColourMode::kGroup) {
        values.assign(set.fibres(), shader::COLOUR_NO_VALUE);
        for (std::size_t group = set.groups.size(); group-- > 0;) {
            for (const std::uint32_t fibre : set.groups[group].fibres) values.at(fibre) = static_cast<float>(group);
        }
    } else if (colour.mode == model::FibreColourMode::kColumn) {
        const auto column =
            std::ranges::find_if(set.fibre_columns, [&](const auto& each) { return each.name == colour.column; });
        if (column == set.fibre_columns.end() || column->components != 1) {
            throw Error(Code::kInvalidArgument, set.source + " has no column '" + colour.column +
                                                    "' of one number per fibre; it has " + names(set.fibre_columns));
        }
        values = column->values;
        for (float& value : values) {
            if (!(std::abs(value) < 3e38F)) value = shader::COLOUR_NO_VALUE;
        }
    }
    return values;
}

std::vector<std::uint32_t> fibreEnds(const model::FibletSet& set) {
    std::vector<std::uint32_t> ends(set.fibres(), 0);
    for (std::size_t f = 0; f < ends.size(); ++f) {
        if (set.fibre_first[f] == set.fibre_first[f + 1]) continue;
        const std::uint32_t last = set.fibre_fiblets[set.fibre_first[f + 1] - 1];
        const std::uint32_t segments = model::fibletSegments(set.heads[last]);
        if (segments == 0) continue;
        const glm::dvec3 from = segmentPlace(set, set.fibre_fiblets[set.fibre_first[f]], 0).from;
        const glm::dvec3 way = segmentPlace(set, last, segments - 1).to - from;
        if (way != glm::dvec3(0)) ends[f] = packedDirection(way);
    }
    return ends;
}

template <typename Value>
void FibreColours::upload(gpu::Device& device, const std::vector<Value>& values) {
    values_ =
        gpu::Buffer(device, std::max<std::size_t>(std::span(values).size_bytes(), 4), gpu::Memory::kDevice, "fibre values");
    if (!values.empty()) gpu::upload(device, values_, 0, std::as_bytes(std::span(values)));
}

void FibreColours::setPoints(gpu::Device& device, const model::FibletSet& set, const model::FibreColour& colour) {
    const auto column = std::ranges::find_if(set.point_columns, [&](const model::PointColumn& each) {
        return each.name == colour.column && each.component == static_cast<std::uint32_t>(colour.component);
    });
    if (column == set.point_columns.end()) {
        throw Error(Code::kInvalidArgument, set.source + " has no column '" + colour.column + "' with component " +
                                                std::to_string(colour.component) + " per point; it has " +
                                                names(set.point_columns));
    }
    upload(device, column->values);
    ranges_ = gpu::Buffer(device, std::max<std::size_t>(std::span(column->ranges).size_bytes(), 8), gpu::Memory::kDevice,
                          "ranges of fiblets");
    if (!column->ranges.empty()) gpu::upload(device, ranges_, 0, std::as_bytes(std::span(column->ranges)));
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (std::size_t f = 0; f < column->ranges.size(); ++f) {
        if (!std::any_of(&column->values[64 * f], &column->values[64 * f] + 64, [](std::uint8_t v) { return v < 255; }))
            continue;
        low = std::min(low, column->ranges[f].x);
        high = std::max(high, column->ranges[f].y);
    }
    if (low <= high) {
        value_min_ = low;
        value_max_ = high;
    }
}

void FibreColours::setDistances(gpu::Device& device, const model::FibletSet& set, const model::FibreColour& colour,
                                const FibreSelector& selector) {
    glm::vec3 low(0), high(0);
    for (std::size_t p = 0; p < set.pages.size(); ++p) {
        low = p == 0 ? set.pages[p].low : glm::min(low, set.pages[p].low);
        high = p == 0 ? set.pages[p].high : glm::max(high, set.pages[p].high);
    }
    grid_ = distanceGrid(*selector.region(colour.region), set.origin_mm + glm::dvec3(low), set.origin_mm + glm::dvec3(high));
    value_max_ = *std::ranges::max_element(grid_.mm);
    upload(device, grid_.mm);
    grid_.mm = {};
}

FibreColours::FibreColours(gpu::Device& device, const model::FibletSet& set, const model::FibreColour& colour,
                           const FibreSelector& selector) {
    if (colour.mode == model::FibreColourMode::kPointColumn) {
        setPoints(device, set, colour);
    } else if (colour.mode == model::FibreColourMode::kDistance) {
        setDistances(device, set, colour, selector);
    } else if (colour.mode == model::FibreColourMode::kEnds) {
        upload(device, fibreEnds(set));
    } else {
        setFibres(device, fibreValues(set, colour));
    }
}

void FibreColours::setFibres(gpu::Device& device, const std::vector<float>& values) {
    if (values.empty()) return;
    upload(device, values);
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const float value : values) {
        if (value >= shader::COLOUR_NO_VALUE) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (low <= high) {
        value_min_ = low;
        value_max_ = high;
    }
}

}  // namespace radiata::render
