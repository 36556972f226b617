// A renderer that sleeps and paints: measures everything but rendering, on machines without a device.
#pragma once

#include <chrono>

#include "session/backend.h"

namespace radiata::session {

/// One dataset, "stub". A picture is a ramp that depends on camera and samples; each sample takes `sample_time`.
Backend stubBackend(std::chrono::milliseconds sample_time);

}  // namespace radiata::session
