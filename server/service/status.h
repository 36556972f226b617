// The only place where errors become gRPC statuses.
#pragma once

#include <grpcpp/support/status.h>

#include "base/error.h"

namespace radiata::service {

/// The sentence is cut to 1000 bytes: it travels in a header.
grpc::Status toStatus(const Error& error);

/// The status of what is being handled; call in a catch clause.
grpc::Status currentStatus();

}  // namespace radiata::service
