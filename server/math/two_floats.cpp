#include "math/two_floats.h"

namespace radiata {

TwoFloats twoFloats(const glm::dvec3& value) {
    TwoFloats result;
    for (int axis = 0; axis < 3; ++axis) {
        // Volatile: vectorised, gcc 12 takes float(x) back to double as x itself, and the rest would be 0.
        const volatile float high = static_cast<float>(value[axis]);
        result.high[axis] = high;
        result.low[axis] = static_cast<float>(value[axis] - static_cast<double>(high));
    }
    return result;
}

}  // namespace radiata
