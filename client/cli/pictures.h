// The two ways to a finished picture: one unary call, or a live view that is waited for until it has come to rest.
#pragma once

#include <functional>
#include <vector>

#include "radiata/v1/frame.pb.h"

#include "common/connection.h"

namespace radiata::client {

/// \throws ClientError(kRefused, kUnreachable)
v1::Frame renderPicture(const Connection& connection, const v1::FrameRequest& request, v1::ImageFormat format,
                        const std::vector<v1::Output>& outputs);

/// Opens a view as a browser does, acknowledges its frames and returns the first converged one. Closes the view.
/// \param seen  gets each frame; may be empty \throws ClientError(kRefused, kUnreachable)
v1::Frame streamPicture(const Connection& connection, const v1::FrameRequest& request,
                        const std::function<void(const v1::Frame&)>& seen = {});

}  // namespace radiata::client
