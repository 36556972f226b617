// Ray parameter by depth, for the ray through a pixel of the window.
float pixelStretch(FibletView view, uint at) {
    const vec2 place = vec2(float(int(at) % view.width + view.window_x) + 0.5 - view.centre.x,
                            view.centre.y - float(int(at) / view.width + view.window_y) - 0.5);
    const vec3 origin = place.x * view.right / dot(view.right, view.right) + place.y * view.up / dot(view.up, view.up);
    return length(origin * view.inverse_distance + view.forward);
}
