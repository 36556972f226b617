// Doubles as sums of two floats: how positions reach shaders without losing the precision that close-ups need.
#pragma once

#include <glm/glm.hpp>

namespace radiata {

struct TwoFloats {
    glm::vec3 high, low;
};

/// high is the value rounded to float, low the rest. |value - high - low| <= 2^-48 |value| per component
/// (tests/unit/math/two_floats_test.cpp), for values whose float is finite and whose rest is not denormal.
TwoFloats twoFloats(const glm::dvec3& value);

}  // namespace radiata
