// Lengths and places of fibres, from their fiblets on the CPU.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "model/fiblet_set.h"

namespace radiata::render {

/// Length of the decoded points of one fibre, and of each, mm.
double fibreLength(const model::FibletSet& set, std::uint32_t fibre);
std::vector<float> fibreLengths(const model::FibletSet& set);

/// Ends of a segment, world mm.
struct FibreSegmentPlace {
    glm::dvec3 from{0}, to{0};
};

/// \param segment  from 0 to the fiblet's segments - 1
FibreSegmentPlace segmentPlace(const model::FibletSet& set, std::uint32_t fiblet, std::uint32_t segment);

/// The names of columns or groups, for messages.
template <typename Named>
std::string names(const std::vector<Named>& all) {
    std::string list;
    for (const Named& each : all) list += (list.empty() ? "" : ", ") + each.name;
    return list.empty() ? "none" : list;
}

}  // namespace radiata::render
