// The way to a server: channel, deadlines, and waiting until it serves.
#pragma once

#include <memory>
#include <string>

#include <grpcpp/grpcpp.h>
#include <CLI/CLI.hpp>

namespace radiata::client {

struct ConnectionOptions {
    std::string address = "127.0.0.1:50051";
    double timeout_s = 600;  ///< of one call; a server without a GPU may need minutes for a large picture
    double wait_s = 0;       ///< how long to wait for a server that is still starting; 0: it must be there
};

/// Adds --server (also taken from RADIATA_SERVER), --timeout and --wait.
void addConnectionOptions(CLI::App& app, ConnectionOptions& options);

class Connection {
public:
    /// Connects, and waits until the server's health service says SERVING.
    /// \throws ClientError(kUnreachable) if it does not within wait_s (with wait_s 0: within 5 s, and without a retry if
    /// refused)
    explicit Connection(const ConnectionOptions& options);

    const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }
    const std::string& address() const { return options_.address; }

    /// Gives a call the deadline that the options ask for.
    void prepare(grpc::ClientContext& context) const;
    /// \throws ClientError if the status is not OK
    void check(const grpc::Status& status) const;

private:
    ConnectionOptions options_;
    std::shared_ptr<grpc::Channel> channel_;
};

/// A channel with a connection of its own: two channels of one program to one address share none. Frames may be of any size.
std::shared_ptr<grpc::Channel> makeChannel(const std::string& address);

}  // namespace radiata::client
