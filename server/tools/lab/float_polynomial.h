// Peters' Algorithm 1 in single precision on the CPU, in two coordinates: the turned frame of his Sec. 3.3, and powers of the
// ray parameter itself, which is what his Fig. 3 shows to fail. Both use the same samples and the same root finder. Source:
// Peters et al. 2023, Sec. 3.2 to 3.5; Eq. 10 with the corrected sqrt(i^i (k-i)^(k-i) / k^k).
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace radiata::lab {

enum class RayCoordinate { kTurnedFrame, kRayParameter };

/// First hit of a ray with |p| = |f(p / |p|)|, in units of amplitude.
class FloatPolynomial {
public:
    /// \param coefficients  even bands up to k, internal convention
    FloatPolynomial(int k, std::vector<float> coefficients);

    /// \param origin  relative to the centre \param direction  unit
    /// \return the ray parameter, or infinity. No error bound: that it can be wrong is the point.
    float firstHit(const glm::vec3& origin, const glm::vec3& direction, RayCoordinate coordinate) const;

private:
    std::vector<float> planePolynomial(const glm::vec3& e, const glm::vec3& direction) const;

    int k_;
    std::vector<float> coefficients_;
    std::vector<std::vector<float>> inverse_vandermonde_;
};

}  // namespace radiata::lab
