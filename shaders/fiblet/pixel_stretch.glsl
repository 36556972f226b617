// Ray parameter by depth, for the ray through a pixel of the window.
#include "shaders/common/pixel_place.glsl"

float pixelStretch(FibletView view, uint at) {
    const ivec2 pixel = pixelPlace(at, uint(view.width)) + ivec2(view.window_x, view.window_y);
    const vec2 place = vec2(float(pixel.x) + 0.5 - view.centre.x, view.centre.y - float(pixel.y) - 0.5);
    const vec3 origin = place.x * view.right / dot(view.right, view.right) + place.y * view.up / dot(view.up, view.up);
    return length(origin * view.inverse_distance + view.forward);
}
