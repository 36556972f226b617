// Unit vectors as two floats: the octahedron |x| + |y| + |z| = 1 unfolded into a square (Meyer et al. 2010). In float32 the way
// there and back is off by less than 3e-7.
#ifndef RADIATA_COMMON_OCTAHEDRAL
#define RADIATA_COMMON_OCTAHEDRAL

vec2 octahedralFold(vec2 p) { return (1.0 - abs(p.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(p, vec2(0.0))); }

vec2 octahedralOf(vec3 n) {
    const vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.z < 0.0 ? octahedralFold(p) : p;
}

vec3 vectorOfOctahedral(vec2 p) {
    const float z = 1.0 - abs(p.x) - abs(p.y);
    return normalize(vec3(z < 0.0 ? octahedralFold(p) : p, z));
}

#endif
