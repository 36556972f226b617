#include "service/convert.h"
#include "service/convert_checks.h"
#include "service/raw_call.h"
#include "service/services.h"

namespace radiata::service {
namespace {

constexpr std::uint64_t kAnswerBytesMax = std::uint64_t{1} << 30;

/// Outputs travel in one message, which protobuf limits to 2 GiB.
void checkOutputs(const model::FrameRequest& request, const model::Outputs& outputs) {
    const std::uint64_t values = (outputs.depth ? 1U : 0U) + (outputs.id ? 4U : 0U) + (outputs.position ? 3U : 0U) +
                                 (outputs.normal ? 3U : 0U) + (outputs.steps ? 1U : 0U);
    const std::uint64_t bytes =
        static_cast<std::uint64_t>(request.width) * static_cast<std::uint64_t>(request.height) * values * 4;
    if (bytes > kAnswerBytesMax) {
        throw Error(Code::kResourceExhausted, "outputs: they would take " + std::to_string(bytes) + " bytes; at most " +
                                                  std::to_string(kAnswerBytesMax) +
                                                  " fit one answer, ask for fewer or smaller");
    }
}

}  // namespace

grpc::ServerUnaryReactor* RenderService::Render(Context*, const Bytes* request, Bytes* response) {
    return unaryCall<v1::RenderRequest>(request, response, [this](UnaryCall* call, const v1::RenderRequest& message) {
        if (!message.has_frame()) refuse("frame is missing");
        session::RenderJob job;
        job.request = fromProto(message.frame(), "frame");
        job.outputs = outputsFromProto(message);
        job.format = formatFromProto(message.format(), "format");
        model::validate(job.request, conductor_.limits());
        checkOutputs(job.request, job.outputs);
        job.done = [call, outputs = job.outputs](session::StreamFrame frame) {
            v1::RenderResponse answer;
            *answer.mutable_frame() = toProto(std::move(frame), outputs);
            call->answer(answer);
        };
        job.failed = [call](const Error& error) { call->refuse(toStatus(error)); };
        // The job may be done, and the call with it, before its number is known here.
        const std::shared_ptr<CancelHook> hook = call->hook();
        const std::uint64_t id = conductor_.render(std::move(job));
        hook->set([this, id] { conductor_.cancel(id); });
    });
}

}  // namespace radiata::service
