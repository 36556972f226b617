// The open-loop schedule: when each client moves its camera is fixed before the run starts, whatever the server does, and
// latency counts from that time. So a server that stalls cannot hide by slowing the questions down (coordinated omission).
#pragma once

#include <cstdint>

namespace radiata::client {

struct Schedule {
    int clients = 1;
    double rate_hz = 30;  ///< camera updates of one client
    double warmup_s = 1;  ///< sent, not counted
    double measured_s = 5;

    /// Updates of one client, those of the warm-up included.
    std::uint64_t updatesPerClient() const { return static_cast<std::uint64_t>((warmup_s + measured_s) * rate_hz); }
    /// Seconds from the start to update `index` (from 0) of a client. Clients are spread evenly over one period.
    double time(int client, std::uint64_t index) const {
        return (static_cast<double>(index) + static_cast<double>(client) / clients) / rate_hz;
    }
    bool measured(int client, std::uint64_t index) const { return time(client, index) >= warmup_s; }
};

}  // namespace radiata::client
