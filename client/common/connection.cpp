#include "common/connection.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "grpc/health/v1/health.grpc.pb.h"

#include "common/client_error.h"

namespace radiata::client {
namespace {

using Clock = std::chrono::system_clock;

Clock::time_point after(double seconds) {
    return Clock::now() + std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000));
}

// One question to the health service. A server without one (UNIMPLEMENTED) serves if it answers at all.
bool serves(const std::shared_ptr<grpc::Channel>& channel, Clock::time_point deadline, std::string& why) {
    const auto stub = grpc::health::v1::Health::NewStub(channel);
    grpc::ClientContext context;
    context.set_deadline(std::min(deadline, after(5)));
    grpc::health::v1::HealthCheckResponse answer;
    const grpc::Status status = stub->Check(&context, {}, &answer);
    if (status.error_code() == grpc::StatusCode::UNIMPLEMENTED) return true;
    if (!status.ok()) {
        why = status.error_message();
        return false;
    }
    why = "its health service does not say SERVING";
    return answer.status() == grpc::health::v1::HealthCheckResponse::SERVING;
}

}  // namespace

void addConnectionOptions(CLI::App& app, ConnectionOptions& options) {
    app.add_option("--server", options.address, "Address of the server, HOST:PORT or unix:PATH")
        ->envname("RADIATA_SERVER")
        ->capture_default_str();
    app.add_option("--timeout", options.timeout_s, "Longest time for one call, seconds")
        ->check(CLI::Range(0.001, 86400.0))
        ->capture_default_str();
    app.add_option("--wait", options.wait_s, "Wait up to this many seconds until the server serves")
        ->check(CLI::Range(0.0, 3600.0));
}

Connection::Connection(const ConnectionOptions& options) : options_(options), channel_(makeChannel(options.address)) {
    const Clock::time_point deadline = after(options.wait_s > 0 ? options.wait_s : 5);
    std::string why = "no answer";
    while (!serves(channel_, deadline, why)) {
        if (options.wait_s <= 0 || Clock::now() + std::chrono::milliseconds(100) >= deadline) {
            throw ClientError(ExitCode::kUnreachable, "server " + options.address + " cannot be reached: " + why);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
}

void Connection::prepare(grpc::ClientContext& context) const { context.set_deadline(after(options_.timeout_s)); }

void Connection::check(const grpc::Status& status) const {
    if (!status.ok()) throw callError(status, options_.address);
}

std::shared_ptr<grpc::Channel> makeChannel(const std::string& address) {
    grpc::ChannelArguments arguments;
    arguments.SetMaxReceiveMessageSize(-1);
    arguments.SetMaxSendMessageSize(-1);
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    // A server that is starting is asked again soon, not after the growing pauses meant for large fleets.
    arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
    arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 100);
    arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 500);
    // Loopback addresses must not take the way through a proxy that the environment names.
    arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
    return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

}  // namespace radiata::client
