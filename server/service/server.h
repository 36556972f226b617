// The gRPC server: services, health, reflection, limits of the transport.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include <grpcpp/grpcpp.h>

#include "session/conductor.h"

namespace radiata::service {

struct ServerOptions {
    std::string listen = "127.0.0.1:50051";           ///< host:port, port 0: any free one; empty: in-process channels only
    bool allow_remote = false;                        ///< let `listen` name an address that other machines reach
    std::size_t memory_max = std::size_t{512} << 20;  ///< bytes that gRPC may hold for transport
};

/// Whether only this machine can reach the address: 127.x.x.x, localhost, [::1], unix sockets.
bool isLoopback(const std::string& listen);

class Server {
public:
    /// \throws Error(kInvalidArgument) for an address beyond loopback without allow_remote,
    ///         Error(kUnavailable) if the address cannot be listened on
    Server(session::Conductor& conductor, const ServerOptions& options);
    ~Server();

    /// The port listened on; 0: none.
    int port() const { return port_; }
    std::shared_ptr<grpc::Channel> inProcessChannel(const grpc::ChannelArguments& arguments = {});

    /// Health says NOT_SERVING, streams end with UNAVAILABLE, what is left after `grace` is cut off. Returns when all calls
    /// ended.
    void stop(std::chrono::milliseconds grace = std::chrono::milliseconds(500));

private:
    struct Services;
    session::Conductor& conductor_;
    std::unique_ptr<Services> services_;
    std::unique_ptr<grpc::Server> server_;
    int port_ = 0;
    bool stopped_ = false;
};

}  // namespace radiata::service
