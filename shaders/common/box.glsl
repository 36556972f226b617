// Ray against axis-aligned box by slabs.
#ifndef RADIATA_COMMON_BOX
#define RADIATA_COMMON_BOX

// 1 / direction with zeros replaced by the smallest number of the same sign, so that slabs never give 0 * inf.
vec3 inverseDirection(vec3 direction) {
    const vec3 tiny = mix(vec3(1e-30), vec3(-1e-30), lessThan(direction, vec3(0.0)));
    return 1.0 / mix(direction, tiny, lessThan(abs(direction), vec3(1e-30)));
}

// Entry and exit parameter; no overlap if entry > exit. Both are moved apart by three roundings, so that no box is missed for them.
vec2 boxSpan(vec3 origin, vec3 inverse_direction, vec3 low, vec3 high) {
    const vec3 a = (low - origin) * inverse_direction;
    const vec3 b = (high - origin) * inverse_direction;
    // A ray in the plane of a face got 0 * 1e30 = 0 there, as if it met the face at its origin only. This makes it 1e10; all other
    // rays lose it in rounding.
    const vec3 grown = 1e-20 * abs(inverse_direction);
    const vec3 first = min(a, b) - grown, last = max(a, b) + grown;
    const float entry = max(first.x, max(first.y, first.z));
    const float leave = min(last.x, min(last.y, last.z));
    const float slack = 4e-7 * max(abs(entry), abs(leave));
    return vec2(entry - slack, leave + slack);
}

#endif
