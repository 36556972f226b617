// Runs a schedule: opens the views, moves the cameras on time, and gathers what came back.
#pragma once

#include <string>
#include <vector>

#include "radiata/v1/view.pb.h"

#include "load/schedule.h"
#include "load/view_client.h"

namespace radiata::client {

/// What one client saw.
struct ClientLog {
    std::vector<FrameRecord> frames;    ///< in order of arrival, those of the warm-up and of refinement included
    std::vector<double> send_delay_ms;  ///< of each update: sent so much after its time; below 0: not sent
    std::uint64_t failed_updates = 0;
    std::string error;  ///< empty if all went well
};

struct RunLog {
    LoadClock::time_point start;  ///< the schedule's time 0
    std::vector<ClientLog> clients;
};

/// Update k of client i shows cameras[(k + i * n / clients) mod n]: clients start apart on the path.
/// Ends at the latest 2 s after the schedule does, unless the machine cannot keep the schedule at all.
/// \throws ClientError(kUnreachable, kRefused) if a view cannot be opened
RunLog runLoad(const std::string& address, const v1::OpenRequest& open, const std::vector<v1::Camera>& cameras,
               const Schedule& schedule);

}  // namespace radiata::client
