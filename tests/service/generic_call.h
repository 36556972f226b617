// Calls with bytes that no generated code would make.
#pragma once

#include <memory>
#include <string>

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>

namespace radiata::service::testing {

struct GenericAnswer {
    grpc::Status status;
    std::string bytes;  ///< of the last message
};

/// Sends one message to "/package.Service/Method" and reads until the call ends, or until the first message if `first_only`.
GenericAnswer genericCall(const std::shared_ptr<grpc::Channel>& channel, const std::string& method, const std::string& bytes,
                          bool first_only = false);

}  // namespace radiata::service::testing
