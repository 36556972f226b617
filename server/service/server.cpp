#include "service/server.h"

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/resource_quota.h>

#include "service/services.h"

namespace radiata::service {
namespace {

void addLimits(grpc::ServerBuilder& builder, const model::Limits& limits, std::size_t memory_max) {
    builder.SetMaxReceiveMessageSize(static_cast<int>(limits.message_bytes_max));
    builder.SetMaxSendMessageSize(-1);
    builder.SetResourceQuota(grpc::ResourceQuota("radiata").Resize(memory_max));
    // Two servers on one port would share its calls, and views would not be found.
    builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
    builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, 1024);
    // A client that vanished without a word is noticed within 15 s.
    builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 10'000);
    builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 5'000);
    builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 5'000);
    // Pictures are compressed already.
    builder.SetDefaultCompressionAlgorithm(GRPC_COMPRESS_NONE);
}

}  // namespace

bool isLoopback(const std::string& listen) {
    if (listen.starts_with("unix:") || listen.starts_with("unix-abstract:")) return true;
    const std::size_t colon = listen.rfind(':');
    const std::string host = listen.substr(0, colon);
    if (host == "localhost" || host == "[::1]") return true;
    return host.starts_with("127.") && host.find_first_not_of("0123456789.") == std::string::npos;
}

struct Server::Services {
    Worker worker, exports;
    Worker loads{64, 2};  ///< may wait for a large dataset, which must not hold up the catalogue
    ViewIds ids;
    ViewService view;
    RenderService render;
    PickService pick;
    CatalogService catalog;
    SelectionService selection;
    LimitsService limits;
    explicit Services(session::Conductor& conductor)
        : view(conductor, loads, ids),
          render(conductor),
          pick(conductor, loads, ids),
          catalog(conductor, worker, loads),
          selection(conductor, loads, exports),
          limits(conductor) {}
};

Server::Server(session::Conductor& conductor, const ServerOptions& options)
    : conductor_(conductor), services_(std::make_unique<Services>(conductor)) {
    if (!options.listen.empty() && !options.allow_remote && !isLoopback(options.listen)) {
        throw Error(Code::kInvalidArgument, "listen address " + options.listen +
                                                " can be reached from other machines, without encryption or login; listen on "
                                                "127.0.0.1 behind nginx, or allow it with --allow-remote");
    }
    // gRPC keeps these two for the whole process and wants them before the first server; calling them again changes nothing.
    grpc::EnableDefaultHealthCheckService(true);
    grpc::reflection::InitProtoReflectionServerBuilderPlugin();
    grpc::ServerBuilder builder;
    addLimits(builder, conductor.limits(), options.memory_max);
    builder.RegisterService(&services_->view);
    builder.RegisterService(&services_->render);
    builder.RegisterService(&services_->pick);
    builder.RegisterService(&services_->catalog);
    builder.RegisterService(&services_->selection);
    builder.RegisterService(&services_->limits);
    if (!options.listen.empty()) builder.AddListeningPort(options.listen, grpc::InsecureServerCredentials(), &port_);
    server_ = builder.BuildAndStart();
    if (!server_ || (!options.listen.empty() && port_ == 0)) {
        throw Error(Code::kUnavailable,
                    "cannot listen on " + options.listen + "; is the port taken by another program? Port 0 takes a free one");
    }
    server_->GetHealthCheckService()->SetServingStatus(true);
}

Server::~Server() { stop(); }

std::shared_ptr<grpc::Channel> Server::inProcessChannel(const grpc::ChannelArguments& arguments) {
    return server_->InProcessChannel(arguments);
}

void Server::stop(std::chrono::milliseconds grace) {
    if (stopped_ || !server_) return;
    stopped_ = true;
    server_->GetHealthCheckService()->SetServingStatus(false);
    conductor_.stop();
    server_->Shutdown(std::chrono::system_clock::now() + grace);
    server_->Wait();
}

}  // namespace radiata::service
