// Segments for the device's own rasteriser. Each carries both of its ends to all its fragments, which find the depth between them as
// raster.comp does: what a rasteriser interpolates is taken where the pixel's centre stands beside the line, far beyond the ends of
// segments that are shorter than a pixel.

//
// The viewport is a square far larger than the picture, about its middle: no line that can be seen needs clipping at its sides. Some
// drivers clip lines of geometry, tessellation and mesh shaders to wrong places (llvmpipe of Mesa 25 does); line.frag discards what then
// strays into the picture.
layout(constant_id = 8) const float kFrame = 4096.0;  // pixels along the viewport's edges

// Clip coordinates of an eye point (fibletEyePoint); depth falls from 1 at the near plane to 0 at the far one.
vec4 fibletClip(FibletView view, vec4 eye) {
    const vec2 middle = view.centre - vec2(view.window_x, view.window_y) - 0.5 * vec2(view.width, view.height);
    const float nearest = 1.0 + view.near_depth * view.inverse_distance;
    const float z = nearest * (view.far_depth - eye.z) / max(view.far_depth - view.near_depth, 1e-30);
    return vec4((middle * eye.w + vec2(eye.x, -eye.y)) * (2.0 / kFrame), z, eye.w);
}

// A place that no picture shows.
vec4 nowhere() { return vec4(0.0, 0.0, 2.0, 1.0); }
