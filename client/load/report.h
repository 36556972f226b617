// What a load run says: times per stage, frames per client, fairness, bytes, skipped camera updates; for people and for
// machines.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "load/harness.h"
#include "load/statistics.h"

namespace radiata::client {

/// Stages, all in ms, of the first frame that answered a camera update:
///   camera_to_frame        from the update's scheduled time until the frame is in the client's hands
///   without_render_encode  camera_to_frame minus render and encode: everything that moves, waits and schedules
///   queue, render, encode  as the server measured them
///   transport              camera_to_frame minus the server's total: network, gRPC, parsing, and the harness itself
///   send_delay             how late the harness sent the update; part of camera_to_frame and transport
struct ClientReport {
    std::uint64_t updates = 0;  ///< scheduled in the measured time
    std::uint64_t frames = 0;   ///< first answers to them
    std::uint64_t skipped = 0;  ///< updates that no frame showed
    std::uint64_t unsent = 0;   ///< held back because the server had stopped answering; part of skipped
    std::uint64_t refined = 0;  ///< further frames of a camera that had been shown already
    std::uint64_t bytes = 0;    ///< of all frames that arrived in the measured time
    std::uint64_t failed_updates = 0;
    std::string error;
    Summary camera_to_frame;
};

struct Report {
    Schedule schedule;
    std::vector<ClientReport> clients;
    std::vector<std::pair<std::string, Summary>> stages;
    double jain = 1;  ///< of the clients' frames

    std::uint64_t total(std::uint64_t ClientReport::*member) const;
};

Report makeReport(const RunLog& log, const Schedule& schedule);
std::string reportTable(const Report& report);
nlohmann::ordered_json reportJson(const Report& report);

}  // namespace radiata::client
