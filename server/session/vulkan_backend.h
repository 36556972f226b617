// The real renderer behind the functions that sessions know: one target per view, one store for all.
#pragma once

#include "render/frame/renderer.h"
#include "session/backend.h"
#include "store/store.h"

namespace radiata::session {

/// Renderer and store must outlive the backend.
Backend vulkanBackend(render::Renderer& renderer, store::Store& store);

}  // namespace radiata::session
