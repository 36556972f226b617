// From a rendered picture to bytes: marks, then encoding. Runs on the encoder threads.
#pragma once

#include "base/error.h"
#include "encode/annotate.h"
#include "session/stream_frame.h"

namespace radiata::session {

/// Writes the marks and encodes; info, outputs and encode_ms are filled in. JPEG has the quality that the request names.
/// \throws Error of the encoders
StreamFrame finish(model::Frame frame, ImageFormat format, encode::Annotator& annotator);

/// What is being handled as an Error; call in a catch clause.
Error currentError();

}  // namespace radiata::session
