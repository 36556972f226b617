// Calls whose messages are parsed here and not by gRPC, so that malformed bytes are answered with a sentence like all other
// bad input, and unary calls that any thread may answer later.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/support/server_callback.h>

#include "base/error.h"
#include "service/status.h"

namespace radiata::service {

/// \throws Error(kInvalidArgument) if the bytes are no message of that type
template <typename Message>
Message parse(const grpc::ByteBuffer& bytes) {
    const std::size_t size = bytes.Length();
    grpc::ByteBuffer copy(bytes);  // shares the bytes; deserialising takes them away
    Message message;
    if (!grpc::SerializationTraits<Message>::Deserialize(&copy, &message).ok()) {
        throw Error(Code::kInvalidArgument, "request: its " + std::to_string(size) + " bytes are no valid " +
                                                Message::descriptor()->full_name() +
                                                "; encode it with the generated code of proto/radiata/v1");
    }
    return message;
}

/// \throws Error(kResourceExhausted) if the message is too large for protobuf (2 GiB)
template <typename Message>
grpc::ByteBuffer serialize(const Message& message) {
    if (message.ByteSizeLong() >= (std::size_t{1} << 31)) {
        throw Error(Code::kResourceExhausted, "answer: " + std::to_string(message.ByteSizeLong()) +
                                                  " bytes do not fit one message; ask for a smaller picture or fewer outputs");
    }
    grpc::ByteBuffer bytes;
    bool own = false;
    if (!grpc::SerializationTraits<Message>::Serialize(message, &bytes, &own).ok()) {
        throw Error(Code::kInternal, "answer: cannot be encoded");
    }
    return bytes;
}

/// Calls a function at most once, when the call is cancelled, also if it was cancelled before the function was known.
class CancelHook {
public:
    void set(std::function<void()> function);
    void cancel();

private:
    std::mutex mutex_;
    bool cancelled_ = false;
    std::function<void()> function_;
};

/// Deletes itself when gRPC is through with it. Exactly one of answer() and refuse() must be called, once, by any thread.
class UnaryCall final : public grpc::ServerUnaryReactor {
public:
    explicit UnaryCall(grpc::ByteBuffer* response) : response_(response), hook_(std::make_shared<CancelHook>()) {}

    template <typename Message>
    void answer(const Message& message) {
        grpc::Status status;
        try {
            *response_ = serialize(message);
        } catch (...) {
            status = currentStatus();
        }
        Finish(status);
    }
    void refuse(const grpc::Status& status) { Finish(status); }

    /// Outlives the call.
    std::shared_ptr<CancelHook> hook() const { return hook_; }
    void OnCancel() override { hook_->cancel(); }
    void OnDone() override { delete this; }

private:
    grpc::ByteBuffer* response_;
    std::shared_ptr<CancelHook> hook_;
};

/// Parses the request and lets `body(call, request)` answer or throw.
template <typename Request, typename Body>
grpc::ServerUnaryReactor* unaryCall(const grpc::ByteBuffer* request, grpc::ByteBuffer* response, Body&& body) {
    auto* call = new UnaryCall(response);
    try {
        body(call, parse<Request>(*request));
    } catch (...) {
        call->refuse(currentStatus());
    }
    return call;
}

}  // namespace radiata::service
