#include "render/fiblet/fibre_look.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "gpu/device.h"
#include "render/fiblet/fibre_measures.h"
#include "shaders/shared/fiblet_draw.glsl"
#include "shaders/shared/layer_look.glsl"

namespace radiata::render {
namespace {

template <typename Named>
std::string names(const std::vector<Named>& all) {
    std::string list;
    for (const Named& each : all) list += (list.empty() ? "" : ", ") + each.name;
    return list.empty() ? "none" : list;
}

/// Whether each fibre passes the set's conditions.
std::vector<bool> passing(const model::FibletSet& set, const model::FibreSet& wanted) {
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
    return passes;
}

}  // namespace

std::vector<std::uint8_t> fibreStates(const model::FibletSet& set, const model::TractogramLayer& layer) {
    std::vector<std::uint8_t> states(set.fibres(), shader::FIBRE_SHOWN);
    const std::vector<bool> shown = passing(set, layer.shown);
    std::vector<bool> selected;
    if (layer.selected) selected = passing(set, *layer.selected);
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

FibreLook::FibreLook(gpu::Device& device, const model::FibletSet& set, const model::TractogramLayer& layer) {
    shown_ = set.fibres();
    if (!layer.shown.isAll() || layer.selected) {
        std::vector<std::uint8_t> states = fibreStates(set, layer);
        selected_ = static_cast<std::uint64_t>(std::ranges::count(states, shader::FIBRE_SELECTED));
        shown_ -= static_cast<std::uint64_t>(std::ranges::count(states, shader::FIBRE_HIDDEN));
        states.resize((states.size() + 7) / 4 * 4);
        states_ = gpu::Buffer(device, states.size(), gpu::Memory::kDevice, "fibre states");
        gpu::upload(device, states_, 0, std::as_bytes(std::span(states)));
    }
    const std::vector<float> values = fibreValues(set, layer.colour);
    if (values.empty()) return;
    values_ = gpu::Buffer(device, std::span(values).size_bytes(), gpu::Memory::kDevice, "fibre values");
    gpu::upload(device, values_, 0, std::as_bytes(std::span(values)));
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
