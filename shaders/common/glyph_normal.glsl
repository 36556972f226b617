// Normal of a glyph. Twin: glyphNormal in server/reference/glyph_hits.
// Source: Peters et al. 2023, Eq. 11, divided by the radius.
#ifndef RADIATA_COMMON_GLYPH_NORMAL
#define RADIATA_COMMON_GLYPH_NORMAL

// r p - f (I - p p^T) grad f, turned outwards by the sign of f.
// \param slope  gradient of any extension of f at p, and f(p), as shEvaluateGradient gives them
// \param p      unit, from the centre to the surface
// \return unit, away from the inside of the glyph
vec3 glyphNormal(vec4 slope, vec3 p) {
    const vec3 tangential = slope.xyz - dot(slope.xyz, p) * p;
    return normalize(abs(slope.w) * p - (slope.w < 0.0 ? -1.0 : 1.0) * tangential);
}

#endif
