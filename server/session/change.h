// What one update of a view asks for.
#pragma once

#include <cstdint>
#include <optional>

#include "model/frame.h"

namespace radiata::session {

struct Size {
    int width = 0;
    int height = 0;
};

/// What is absent stays as it is.
struct Change {
    std::uint64_t acknowledged_sequence = 0;
    std::uint64_t camera_sequence = 0;
    std::optional<model::Camera> camera;
    std::optional<model::Scene> scene;
    std::optional<model::Quality> quality;
    std::optional<Size> size;
    double client_time_ms = 0;
};

}  // namespace radiata::session
