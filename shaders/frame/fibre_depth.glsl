// Depth cues of fibres from the surface buffer: occlusion in screen space, and halos. Included where SurfaceBuffer is known.
#include "shaders/common/fibre_depth_cues.glsl"

layout(constant_id = 7) const bool kFibreOcclusion = false;
layout(constant_id = 8) const bool kFibreHalos = false;

// mm across a pixel at the depth of what it shows.
float pixelSize(FrameParams frame, vec3 direction, float depth) {
    const float forward = depth * dot(direction, frame.rays.forward);
    return length(frame.rays.step_right) * max(1.0 + forward * frame.rays.inverse_distance, 1e-5);
}

float depthBeside(SurfaceBuffer surfaces, FrameParams frame, ivec2 pixel) {
    const ivec2 inside = clamp(pixel, ivec2(0), ivec2(frame.width, frame.height) - 1);
    return surfaces.at[inside.y * int(frame.width) + inside.x].depth;
}

// Factor on the light of a fibre's pixel.
float openness(SurfaceBuffer surfaces, FrameParams frame, float radius, uint at, float depth, float size_mm) {
    const ivec2 pixel = pixelPlace(at, frame.width);
    // Turned differently from pixel to pixel and from sample to sample, so that the samples of a picture at rest average.
    const uint turned = (at * 2654435761u ^ frame.sample_index * 2246822519u) >> 8u;
    const float turn = float(turned) * (6.28318531 / 16777216.0);
    float sum = 0.0;
    for (uint i = 0u; i < kCueSamples; ++i) {
        const ivec2 place = pixel + ivec2(round(cuePlace(i, radius, turn)));
        sum += cueOcclusion(depth - depthBeside(surfaces, frame, place), radius * size_mm);
    }
    return 1.0 - 0.9 * sum / float(kCueSamples);
}

// Whether a nearer fibre's halo hides the pixel.
bool inHalo(SurfaceBuffer surfaces, FrameParams frame, float width, uint at, float depth, float size_mm) {
    const ivec2 pixel = pixelPlace(at, frame.width);
    const int reach = int(ceil(width));
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            const float away = length(vec2(x, y));
            const float ahead = depth - depthBeside(surfaces, frame, pixel + ivec2(x, y));
            if (away > 0.0 && away <= haloRadius(ahead, width, 2.0 * width * size_mm)) return true;
        }
    }
    return false;
}
