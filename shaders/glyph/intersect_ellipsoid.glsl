// Ellipsoids of tensors of order 2, met exactly: the points D u of the unit sphere's u, so |D^-1 p| = 1. Included by intersect.glsl in
// place of the march where METHOD_ELLIPSOID is defined. layer.tensors holds D^-1 of each instance: xx, xy, xz, yy, yz, zz.
// Hlawitschka et al., Sec. 7, advise this explicit intersection against their own march.

mat3 ellipsoidInverse(GlyphLayerParams layer, uint index) {
    FloatBuffer source = FloatBuffer(layer.tensors + uint64_t(index) * 24ul);
    const float xx = source.at[0], xy = source.at[1], xz = source.at[2], yy = source.at[3], yz = source.at[4], zz = source.at[5];
    return mat3(xx, xy, xz, xy, yy, yz, xz, yz, zz);
}

void intersectInstance(FrameParams frame, GlyphLayerParams layer, uint index, GlyphInstance instance, vec3 centre) {
    const mat3 inverse_tensor = ellipsoidInverse(layer, index);
    const float unit = 1.0 / instance.scale;
    const vec3 origin = (ray.origin - centre) * unit;
    // In the space of u the ellipsoid is the unit sphere.
    const vec3 o = inverse_tensor * origin, d = inverse_tensor * ray.direction;
    const float length_d = length(d);
    const RayPlane plane = rayPlane(o, d / length_d);
    ++total_steps;
    if (plane.h >= 1.0) return;
    const float half_chord = sqrt((1.0 - plane.h) * (1.0 + plane.h));
    const float first = (plane.closest - half_chord) / length_d, second = (plane.closest + half_chord) / length_d;
    const float near = ray.near * unit;
    const float s = first >= near ? first : second;
    const float t = s * instance.scale;
    if (s >= near && (t < best_t || (t == best_t && index < best_instance))) {
        best_t = t;
        best_instance = index;
        best_direction = normalize(origin + s * ray.direction);
    }
}

// \param p  from the centre to the surface, any length: the gradient of |D^-1 p|^2 keeps its direction
vec3 methodNormal(GlyphLayerParams layer, uint index, vec3 p) {
    const mat3 inverse_tensor = ellipsoidInverse(layer, index);
    return normalize(inverse_tensor * (inverse_tensor * p));
}
