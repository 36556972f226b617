// Segments for the device's own rasteriser. Each carries both of its ends to all its fragments, which find the depth between them as
// raster.comp does: what a rasteriser interpolates is taken where the pixel's centre stands beside the line, far beyond the ends of
// segments that are shorter than a pixel.

// Clip coordinates of an eye point (fibletEyePoint); depth falls from 1 at the near plane to 0 at the far one.
vec4 fibletClip(FibletView view, vec4 eye) {
    const vec2 size = vec2(view.width, view.height);
    const vec2 middle = 2.0 * (view.centre - vec2(view.window_x, view.window_y)) / size - 1.0;
    const float nearest = 1.0 + view.near_depth * view.inverse_distance;
    const float z = nearest * (view.far_depth - eye.z) / max(view.far_depth - view.near_depth, 1e-30);
    return vec4(middle * eye.w + 2.0 * vec2(eye.x, -eye.y) / size, z, eye.w);
}

// A place that no picture shows.
vec4 nowhere() { return vec4(0.0, 0.0, 2.0, 1.0); }
