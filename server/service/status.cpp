#include "service/status.h"

#include <string>

#include "session/finish.h"

namespace radiata::service {
namespace {

constexpr std::size_t kSentenceMax = 1000;

grpc::StatusCode toCode(Code code) {
    switch (code) {
        case Code::kInvalidArgument:
            return grpc::StatusCode::INVALID_ARGUMENT;
        case Code::kNotFound:
            return grpc::StatusCode::NOT_FOUND;
        case Code::kCorrupt:
            return grpc::StatusCode::DATA_LOSS;
        case Code::kUnsupported:
            return grpc::StatusCode::UNIMPLEMENTED;
        case Code::kResourceExhausted:
            return grpc::StatusCode::RESOURCE_EXHAUSTED;
        case Code::kUnavailable:
            return grpc::StatusCode::UNAVAILABLE;
        case Code::kCancelled:
            return grpc::StatusCode::CANCELLED;
        case Code::kInternal:
            return grpc::StatusCode::INTERNAL;
    }
    return grpc::StatusCode::INTERNAL;
}

}  // namespace

grpc::Status toStatus(const Error& error) { return {toCode(error.code()), std::string(error.what()).substr(0, kSentenceMax)}; }

grpc::Status currentStatus() { return toStatus(session::currentError()); }

}  // namespace radiata::service
