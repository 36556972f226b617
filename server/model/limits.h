// What a request may ask for. One place; the limits call publishes it and the checks read it.
#pragma once

#include <cstdint>

#include "model/frame.h"

namespace radiata::model {

struct Limits {
    int width_max = 8192;
    int height_max = 8192;
    std::uint64_t pixels_max = 16'777'216;
    int samples_max = 64;
    int shadow_rays_max = 32;
    int occlusion_rays_max = 32;
    float angular_radius_max_deg = 60;
    int layers_max = 8;
    int ray_march_steps_max = 1000;
    int views_max = 64;
    int window_max = 8;
    std::uint64_t message_bytes_max = 1 << 20;
    std::uint64_t tract_memory_bytes = 0;  ///< device memory for the fiblets of one tractogram; 0: as much as it takes
};

/// Checks everything about a request that needs no dataset.
/// \throws Error(kInvalidArgument or kResourceExhausted) naming field, value and range
void validate(const FrameRequest& request, const Limits& limits);

}  // namespace radiata::model
