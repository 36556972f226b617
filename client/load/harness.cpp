#include "load/harness.h"

#include <memory>
#include <thread>

#include "common/client_error.h"
#include "common/connection.h"

namespace radiata::client {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kOpenTimeout{10'000};
constexpr milliseconds kDrain{1'000};

using Clients = std::vector<std::unique_ptr<ViewClient>>;

Clients openViews(const std::string& address, const v1::OpenRequest& open, const Schedule& schedule) {
    const auto life = std::chrono::duration<double>(schedule.warmup_s + schedule.measured_s + 60);
    const auto deadline =
        std::chrono::system_clock::now() + std::chrono::duration_cast<std::chrono::system_clock::duration>(life);
    Clients clients;
    for (int i = 0; i < schedule.clients; ++i) {
        clients.push_back(std::make_unique<ViewClient>(makeChannel(address), open, deadline));
    }
    for (const auto& client : clients) {
        if (client->waitOpened(kOpenTimeout)) continue;
        const grpc::Status status = client->status();
        throw status.ok() ? ClientError(ExitCode::kUnreachable, "server " + address + " opened no view within 10 s")
                          : callError(status, address);
    }
    return clients;
}

void sendAll(Clients& clients, const std::vector<v1::Camera>& cameras, const Schedule& schedule, RunLog& log) {
    const std::size_t count = clients.size();
    for (std::uint64_t index = 0; index < schedule.updatesPerClient(); ++index) {
        for (std::size_t i = 0; i < count; ++i) {
            const double time_s = schedule.time(static_cast<int>(i), index);
            const auto due = log.start + std::chrono::duration_cast<LoadClock::duration>(std::chrono::duration<double>(time_s));
            std::this_thread::sleep_until(due);
            const double delay_ms = std::chrono::duration<double, std::milli>(LoadClock::now() - due).count();
            const v1::Camera& camera = cameras[(index + i * cameras.size() / count) % cameras.size()];
            const bool sent = clients[i]->sendCamera(camera, index + 1);
            log.clients[i].send_delay_ms.push_back(sent ? delay_ms : -1);
        }
    }
}

}  // namespace

RunLog runLoad(const std::string& address, const v1::OpenRequest& open, const std::vector<v1::Camera>& cameras,
               const Schedule& schedule) {
    Clients clients = openViews(address, open, schedule);
    RunLog log;
    log.clients.resize(clients.size());
    log.start = LoadClock::now() + milliseconds(50);
    sendAll(clients, cameras, schedule, log);
    const auto end = LoadClock::now() + kDrain;
    for (const auto& client : clients) {
        const auto left = std::chrono::duration_cast<milliseconds>(end - LoadClock::now());
        client->waitFrame(schedule.updatesPerClient(), std::max(left, milliseconds(0)));
    }
    for (const auto& client : clients) client->close();
    for (std::size_t i = 0; i < clients.size(); ++i) {
        log.clients[i].frames = clients[i]->frames();
        log.clients[i].failed_updates = clients[i]->failedUpdates();
        if (!clients[i]->status().ok()) log.clients[i].error = callError(clients[i]->status(), address).what();
    }
    return log;
}

}  // namespace radiata::client
