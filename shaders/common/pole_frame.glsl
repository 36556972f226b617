// The pole frame of a glyph: q towards the camera (or against the common direction of parallel rays), n1 and n2 orthogonal to it.
// Rays through the camera span planes that contain q; see generate/pole_table.py for the frame's definition and the table.
#ifndef RADIATA_COMMON_POLE_FRAME
#define RADIATA_COMMON_POLE_FRAME

struct PoleCircle {
    vec2 azimuth;  // (cos, sin) of the ray plane's azimuth in the pole frame
    vec2 offset;   // (cos, sin) of the angle phi at which the pole stands on the ray's circle
};

PoleCircle poleCircle(vec3 q, vec3 d, vec3 e) {
    const float sin_theta = length(q.xy);
    const vec2 turn = sin_theta > 1e-12 ? q.xy / sin_theta : vec2(1.0, 0.0);
    const vec3 n1 = vec3(turn * q.z, -sin_theta);
    const vec3 n2 = vec3(-turn.y, turn.x, 0.0);
    PoleCircle circle;
    circle.offset = vec2(-dot(d, q), dot(e, q));
    const vec3 u = circle.offset.y * d + circle.offset.x * e;
    circle.azimuth = normalize(vec2(dot(u, n1), dot(u, n2)));
    return circle;
}

// The unit vector in which the plane of d and e (orthonormal) meets z = 0; any of that plane if it is z = 0 itself.
vec3 horizontalOf(vec3 d, vec3 e) {
    const vec2 q = d.z * e.xy - e.z * d.xy;
    const float size = length(q);
    return size > 1e-12 ? vec3(q / size, 0.0) : vec3(1.0, 0.0, 0.0);
}

// Fourier coefficients in phi from those in the angle from the pole: F[h] times exp(-i stride h offset), in the (a, b) of a cos + b sin.
void poleCircleShift(inout vec2 F[CIRCLE_HARMONICS + 1], vec2 offset) {
#if SH_FULL
    const vec2 step = offset;
#else
    const vec2 step = vec2(offset.x * offset.x - offset.y * offset.y, 2.0 * offset.x * offset.y);
#endif
    vec2 power = step;
    for (int h = 1; h <= CIRCLE_HARMONICS; ++h) {
        F[h] = vec2(F[h].x * power.x - F[h].y * power.y, F[h].y * power.x + F[h].x * power.y);
        power = vec2(power.x * step.x - power.y * step.y, power.x * step.y + power.y * step.x);
    }
}

#endif
