// Rays through picture points. See CameraRays in shaders/shared/frame.glsl. Twin: server/reference/camera_rays.
#ifndef RADIATA_COMMON_CAMERA_RAYS
#define RADIATA_COMMON_CAMERA_RAYS

struct PixelRay {
    vec3 origin;     // on the reference plane, relative to the reference point, mm
    vec3 direction;  // unit
    float near;      // first and last parameter that is seen, mm
    float far;
};

// \param point  pixels, from the picture's upper left corner, right and down
PixelRay pixelRay(CameraRays rays, vec2 size, vec2 point) {
    PixelRay ray;
    ray.origin = (point.x - 0.5 * size.x) * rays.step_right + (0.5 * size.y - point.y) * rays.step_up;
    const vec3 direction = ray.origin * rays.inverse_distance + rays.forward;
    const float stretch = length(direction);  // of the parameter against the depth
    ray.direction = direction / stretch;
    ray.near = rays.near_depth * stretch;
    ray.far = rays.far_depth * stretch;
    return ray;
}

// Axis of the pole frame (pole_frame.glsl): from a glyph's centre (relative to the reference point, mm) to the camera. Far cameras keep their precision, as only
// ratios to the distance enter.
vec3 poleAxis(CameraRays rays, vec3 centre) { return normalize(-rays.forward - centre * rays.inverse_distance); }

#endif
