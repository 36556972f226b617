// Light reflected by a glyph: glTF's dielectric and a constant ambient light. Twin: server/reference/shading.
// Source: glTF 2.0 specification, Appendix B.3 (fresnel_mix of a Lambertian base under a GGX coat, F0 = 0.04).
#ifndef RADIATA_COMMON_BRDF
#define RADIATA_COMMON_BRDF

// BRDF times the cosine of the light.
// \param base  linear RGB; \param roughness  perceptual, above 0 up to 1
// \param normal, viewer, light  unit; viewer and light point away from the surface
// A viewer behind or within 1e-3 of the horizon is treated as if its cosine were 1e-3; a light behind it gives 0.
vec3 dielectricBrdfCosine(vec3 base, float roughness, vec3 normal, vec3 viewer, vec3 light) {
    const float n_l = min(dot(normal, light), 1.0);
    if (n_l <= 0.0) return vec3(0.0);
    const float n_v = clamp(dot(normal, viewer), 1e-3, 1.0);
    const vec3 between = viewer + light;
    const vec3 halfway = between * inversesqrt(max(dot(between, between), 1e-12));
    const float n_h = clamp(dot(normal, halfway), 0.0, 1.0);
    const float v_h = min(abs(dot(viewer, halfway)), 1.0);
    const float a2 = roughness * roughness * roughness * roughness;
    const float peak = n_h * n_h * (a2 - 1.0) + 1.0;
    const float density = a2 / (3.14159265 * peak * peak);
    const float visibility = 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2));
    const float missed = 1.0 - v_h, missed2 = missed * missed;
    const float fresnel = 0.04 + 0.96 * missed2 * missed2 * missed;
    return mix(base * 0.318309886, vec3(density * visibility), fresnel) * n_l;
}

// Radiance towards the viewer: the BRDF lit by one distant light, plus ambient * base.
// \param irradiance  on a surface that faces the light; pi lights a white diffuser to 1
vec3 shadeDielectric(vec3 base, float roughness, vec3 normal, vec3 viewer, vec3 light, float irradiance, float ambient) {
    return irradiance * dielectricBrdfCosine(base, roughness, normal, viewer, light) + ambient * base;
}

#endif
