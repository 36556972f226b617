#include "service/generic_call.h"

#include <stdexcept>

namespace radiata::service::testing {
namespace {

/// Waits for the one operation under way.
bool next(grpc::CompletionQueue& queue) {
    void* tag = nullptr;
    bool ok = false;
    const auto deadline = std::chrono::system_clock::now() + std::chrono::seconds(10);
    if (queue.AsyncNext(&tag, &ok, deadline) != grpc::CompletionQueue::GOT_EVENT) throw std::runtime_error("no answer in 10 s");
    return ok;
}

}  // namespace

GenericAnswer genericCall(const std::shared_ptr<grpc::Channel>& channel, const std::string& method, const std::string& bytes,
                          bool first_only) {
    grpc::GenericStub stub(channel);
    grpc::ClientContext context;
    grpc::CompletionQueue queue;
    const auto call = stub.PrepareCall(&context, method, &queue);
    GenericAnswer answer;
    call->StartCall(nullptr);
    next(queue);
    const grpc::Slice slice(bytes);
    const grpc::ByteBuffer message(&slice, 1);
    call->WriteLast(message, grpc::WriteOptions(), nullptr);
    next(queue);
    while (true) {
        grpc::ByteBuffer response;
        call->Read(&response, nullptr);
        if (!next(queue)) break;
        std::vector<grpc::Slice> slices;
        response.Dump(&slices);
        answer.bytes.clear();
        for (const grpc::Slice& part : slices) answer.bytes.append(reinterpret_cast<const char*>(part.begin()), part.size());
        if (first_only) context.TryCancel();
    }
    call->Finish(&answer.status, nullptr);
    next(queue);
    queue.Shutdown();
    void* tag = nullptr;
    bool ok = false;
    while (queue.Next(&tag, &ok)) {
    }
    return answer;
}

}  // namespace radiata::service::testing
