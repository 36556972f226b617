// Light reflected by a thin line: a cylinder too thin to see, of whose normals those that reflect most towards the viewer are
// taken. Twin: server/reference/illuminated_line.
// Source: Zoeckler et al. 1996, Eq. 6 and 8 (the maximum principle), with the dielectric of common/brdf.glsl.
#ifndef RADIATA_COMMON_ILLUMINATED_LINE
#define RADIATA_COMMON_ILLUMINATED_LINE

// BRDF times the cosine of the light, each at its greatest over the normals orthogonal to the tangent.
// \param base  linear RGB; \param roughness  perceptual, above 0 up to 1; \param tangent, viewer, light  unit; either sign of the tangent
vec3 illuminatedLine(vec3 base, float roughness, vec3 tangent, vec3 viewer, vec3 light) {
    const float t_l = dot(tangent, light), t_v = dot(tangent, viewer);
    const float n_l = sqrt(max(1.0 - t_l * t_l, 0.0)), n_v = sqrt(max(1.0 - t_v * t_v, 1e-6));
    const vec3 between = viewer + light;
    const float t_h = dot(tangent, between) * inversesqrt(max(dot(between, between), 1e-12));
    const float n_h2 = clamp(1.0 - t_h * t_h, 0.0, 1.0);
    const float v_h = min(sqrt(max(dot(between, between), 0.0)) * 0.5, 1.0);  // cosine of half the angle between them
    const float a2 = roughness * roughness * roughness * roughness;
    const float peak = n_h2 * (a2 - 1.0) + 1.0;
    const float density = a2 / (3.14159265 * peak * peak);
    const float visibility =
        0.5 / max(n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2), 1e-6);
    const float missed = 1.0 - v_h, missed2 = missed * missed;
    const float fresnel = 0.04 + 0.96 * missed2 * missed2 * missed;
    return mix(base * 0.318309886, vec3(density * visibility), fresnel) * n_l;
}

#endif
