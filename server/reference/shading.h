// Reflection and transfer curve in double. Twins of shaders/common/brdf.glsl and srgb.glsl.
// Source: glTF 2.0 specification, Appendix B.2 and B.3 (dielectric BRDF), written with tangents as in Walter et al. 2007
// instead of the shader's products of cosines.
#pragma once

#include <glm/glm.hpp>

namespace radiata::reference {

/// glTF's dielectric BRDF (F0 = 0.04, GGX, height-correlated Smith masking) times the cosine of the light.
/// \param base    linear RGB; \param roughness  perceptual, above 0 up to 1
/// \param normal, viewer, light  unit; viewer and light point away from the surface
/// A viewer behind or within 1e-3 of the horizon is treated as if its cosine were 1e-3; a light behind it gives 0.
glm::dvec3 dielectricBrdfCosine(const glm::dvec3& base, double roughness, const glm::dvec3& normal, const glm::dvec3& viewer,
                                const glm::dvec3& light);

/// Radiance towards the viewer: the BRDF lit by one distant light, plus ambient * base.
/// \param irradiance  on a surface that faces the light; pi lights a white diffuser to 1
glm::dvec3 shadeDielectric(const glm::dvec3& base, double roughness, const glm::dvec3& normal, const glm::dvec3& viewer,
                           const glm::dvec3& light, double irradiance, double ambient);

/// IEC 61966-2-1. Arguments outside 0 to 1 are clamped.
double srgbFromLinear(double linear);
double linearFromSrgb(double encoded);

}  // namespace radiata::reference
