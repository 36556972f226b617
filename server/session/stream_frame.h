// A finished frame on its way to a client.
#pragma once

#include <cstdint>
#include <vector>

#include "model/frame.h"

namespace radiata::session {

enum class ImageFormat { kPng, kJpeg };

/// Wall-clock times on the server, ms.
struct Timing {
    double queue_ms = 0;  ///< from the arrival of the camera to the start of rendering
    double render_ms = 0;
    double encode_ms = 0;
    double total_ms = 0;  ///< from the arrival of the camera to the hand-over to the transport
    double client_time_ms = 0;
};

struct StreamFrame {
    std::uint64_t sequence = 1;  ///< counts the frames of a view as they are handed over
    std::uint64_t camera_sequence = 0;
    model::FrameInfo info;
    model::FramePixels outputs;  ///< without rgba; empty in a view
    int width = 0;
    int height = 0;
    ImageFormat format = ImageFormat::kPng;
    std::vector<std::uint8_t> image;
    Timing timing;
    bool echo_request = true;  ///< whether info.request is news to the client
};

}  // namespace radiata::session
