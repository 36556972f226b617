// Figures of the load harness from a run that is written down here: what counts, what is skipped, from when latency counts.
#include "load/report.h"

#include <gtest/gtest.h>

namespace radiata::client {
namespace {

using std::chrono::microseconds;

TEST(Statistics, PercentilesAreNearestRanks) {
    std::vector<double> values;
    for (int i = 100; i >= 1; --i) values.push_back(i);
    const Summary summary = summarise(values);
    EXPECT_EQ(summary.p50, 50);
    EXPECT_EQ(summary.p95, 95);
    EXPECT_EQ(summary.p99, 99);
    EXPECT_EQ(summary.maximum, 100);
    EXPECT_EQ(summary.mean, 50.5);
    EXPECT_EQ(summarise({7}).p99, 7);
    EXPECT_EQ(summarise({}).count, 0U);
}

TEST(Statistics, JainIndexRunsFromOneOverNToOne) {
    EXPECT_DOUBLE_EQ(jainIndex({5, 5, 5, 5}), 1);
    EXPECT_DOUBLE_EQ(jainIndex({8, 0, 0, 0}), 0.25);
    EXPECT_DOUBLE_EQ(jainIndex({0, 0}), 1);
}

TEST(Schedule, SpreadsTheClientsOverOnePeriod) {
    const Schedule schedule{4, 10, 1, 2};
    EXPECT_EQ(schedule.updatesPerClient(), 30U);
    EXPECT_DOUBLE_EQ(schedule.time(0, 3), 0.3);
    EXPECT_DOUBLE_EQ(schedule.time(2, 3), 0.35);
    EXPECT_FALSE(schedule.measured(3, 9));
    EXPECT_TRUE(schedule.measured(0, 10));
}

TEST(Report, CountsFromTheScheduledTime) {
    // One client at 10 Hz: updates 1 and 2 are warm-up (0 and 0.1 s), 3, 4 and 5 are measured (0.2, 0.3, 0.4 s).
    const Schedule schedule{1, 10, 0.2, 0.3};
    RunLog log;
    log.start = LoadClock::time_point{} + microseconds(5'000'000);
    log.clients.resize(1);
    // Update 4 went out 20 ms late; update 5 was held back.
    log.clients[0].send_delay_ms = {0, 0, 1, 20, -1};
    const auto frame = [&](std::uint64_t sequence, int at_us) {
        return FrameRecord{sequence, log.start + microseconds(at_us), 1, 6, 3, 11, 1000};
    };
    // The opening frame, a warm-up answer, the answer to 3, a refinement of it, the answer to 4.
    log.clients[0].frames = {frame(0, 1'000), frame(1, 12'000), frame(3, 215'000), frame(3, 290'000), frame(4, 340'000)};
    const Report report = makeReport(log, schedule);
    const ClientReport& client = report.clients[0];
    EXPECT_EQ(client.updates, 3U);
    EXPECT_EQ(client.frames, 2U);
    EXPECT_EQ(client.skipped, 1U);
    EXPECT_EQ(client.unsent, 1U);
    EXPECT_EQ(client.refined, 1U);
    EXPECT_EQ(client.bytes, 3000U);
    EXPECT_NEAR(client.camera_to_frame.p50, 15, 1e-9);
    EXPECT_NEAR(client.camera_to_frame.maximum, 40, 1e-9);
    const nlohmann::ordered_json json = reportJson(report);
    EXPECT_NEAR(json["stages_ms"]["without_render_encode"]["max"].get<double>(), 31, 1e-9);
    EXPECT_NEAR(json["stages_ms"]["transport"]["p50"].get<double>(), 4, 1e-9);
    EXPECT_EQ(json["stages_ms"]["send_delay"]["max"].get<double>(), 20);
    EXPECT_EQ(json["jain"].get<double>(), 1);
    EXPECT_NE(reportTable(report).find("2 frames of 3 camera updates, 1 skipped"), std::string::npos);
}

}  // namespace
}  // namespace radiata::client
