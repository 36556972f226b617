// Directions above a surface with a density proportional to the cosine, for ambient light that comes from everywhere alike: an even
// distribution on the unit disk, lifted to the hemisphere (Malley's method). Twin: server/reference/projected_cap (radius pi / 2).
#ifndef RADIATA_COMMON_COSINE_HEMISPHERE
#define RADIATA_COMMON_COSINE_HEMISPHERE

// \param normal  unit; \param u  in [0, 1)^2; \return unit
vec3 cosineHemisphereSample(vec3 normal, vec2 u) {
    const vec3 other = abs(normal.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    const vec3 x_axis = normalize(cross(normal, other)), y_axis = cross(normal, x_axis);
    const float r = sqrt(u.x), turn = 6.28318531 * u.y;
    return normalize(r * cos(turn) * x_axis + r * sin(turn) * y_axis + sqrt(max(1.0 - u.x, 0.0)) * normal);
}

#endif
