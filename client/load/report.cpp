#include "load/report.h"

#include <set>

#include "common/table.h"

namespace radiata::client {
namespace {

struct Samples {
    std::vector<double> camera_to_frame, without, queue, render, encode, transport, send_delay;
};

ClientReport reportClient(const RunLog& log, const Schedule& schedule, int client, Samples& samples) {
    const ClientLog& entry = log.clients[static_cast<std::size_t>(client)];
    ClientReport report;
    report.failed_updates = entry.failed_updates;
    report.error = entry.error;
    for (std::uint64_t index = 0; index < entry.send_delay_ms.size(); ++index) {
        if (!schedule.measured(client, index)) continue;
        ++report.updates;
        if (entry.send_delay_ms[index] < 0) {
            ++report.unsent;
        } else {
            samples.send_delay.push_back(entry.send_delay_ms[index]);
        }
    }
    std::set<std::uint64_t> shown;
    std::vector<double> latencies;
    for (const FrameRecord& frame : entry.frames) {
        const double arrival_s = std::chrono::duration<double>(frame.arrival - log.start).count();
        if (arrival_s >= schedule.warmup_s) report.bytes += frame.bytes;
        const std::uint64_t sequence = frame.camera_sequence;
        if (sequence == 0 || sequence > entry.send_delay_ms.size() || !schedule.measured(client, sequence - 1)) continue;
        if (!shown.insert(sequence).second) {
            ++report.refined;
            continue;
        }
        ++report.frames;
        const double latency_ms = (arrival_s - schedule.time(client, sequence - 1)) * 1e3;
        latencies.push_back(latency_ms);
        samples.camera_to_frame.push_back(latency_ms);
        samples.without.push_back(latency_ms - frame.render_ms - frame.encode_ms);
        samples.queue.push_back(frame.queue_ms);
        samples.render.push_back(frame.render_ms);
        samples.encode.push_back(frame.encode_ms);
        samples.transport.push_back(latency_ms - frame.total_ms);
    }
    report.skipped = report.updates - report.frames;
    report.camera_to_frame = summarise(latencies);
    return report;
}

nlohmann::ordered_json summaryJson(const Summary& summary) {
    return {{"count", summary.count}, {"mean", summary.mean}, {"p50", summary.p50},
            {"p95", summary.p95},     {"p99", summary.p99},   {"max", summary.maximum}};
}

Row summaryRow(const std::string& name, const Summary& summary) {
    Row row = {name};
    for (const double value : {summary.p50, summary.p95, summary.p99, summary.maximum}) row.push_back(formatNumber(value, 2));
    return row;
}

}  // namespace

std::uint64_t Report::total(std::uint64_t ClientReport::*member) const {
    std::uint64_t sum = 0;
    for (const ClientReport& client : clients) sum += client.*member;
    return sum;
}

Report makeReport(const RunLog& log, const Schedule& schedule) {
    Report report;
    report.schedule = schedule;
    Samples samples;
    std::vector<double> shares;
    for (int i = 0; i < schedule.clients; ++i) {
        report.clients.push_back(reportClient(log, schedule, i, samples));
        shares.push_back(static_cast<double>(report.clients.back().frames));
    }
    report.jain = jainIndex(shares);
    report.stages = {{"camera_to_frame", summarise(samples.camera_to_frame)},
                     {"without_render_encode", summarise(samples.without)},
                     {"queue", summarise(samples.queue)},
                     {"render", summarise(samples.render)},
                     {"encode", summarise(samples.encode)},
                     {"transport", summarise(samples.transport)},
                     {"send_delay", summarise(samples.send_delay)}};
    return report;
}

std::string reportTable(const Report& report) {
    std::vector<Row> stages;
    for (const auto& [name, summary] : report.stages) stages.push_back(summaryRow(name, summary));
    std::vector<Row> clients;
    for (std::size_t i = 0; i < report.clients.size(); ++i) {
        const ClientReport& client = report.clients[i];
        clients.push_back({std::to_string(i + 1), std::to_string(client.updates), std::to_string(client.frames),
                           std::to_string(client.skipped), std::to_string(client.refined),
                           formatBytes(static_cast<double>(client.bytes)), formatNumber(client.camera_to_frame.p50, 2),
                           formatNumber(client.camera_to_frame.p95, 2)});
    }
    const double seconds = report.schedule.measured_s;
    const std::uint64_t frames = report.total(&ClientReport::frames);
    const std::uint64_t bytes = report.total(&ClientReport::bytes);
    std::string text =
        formatTable({"stage, ms", "p50", "p95", "p99", "max"}, stages) + "\n" +
        formatTable({"client", "updates", "frames", "skipped", "refined", "bytes", "p50 ms", "p95 ms"}, clients) + "\n";
    text += std::to_string(frames) + " frames of " + std::to_string(report.total(&ClientReport::updates)) +
            " camera updates, " + std::to_string(report.total(&ClientReport::skipped)) + " skipped, " +
            formatNumber(static_cast<double>(frames) / seconds, 1) + " frames/s, " + formatBytes(static_cast<double>(bytes)) +
            ", " + formatBytes(static_cast<double>(bytes) / seconds) + "/s, Jain " + formatNumber(report.jain, 4) + "\n";
    return text;
}

nlohmann::ordered_json reportJson(const Report& report) {
    nlohmann::ordered_json stages, clients = nlohmann::ordered_json::array();
    for (const auto& [name, summary] : report.stages) stages[name] = summaryJson(summary);
    for (const ClientReport& client : report.clients) {
        clients.push_back({{"updates", client.updates},
                           {"frames", client.frames},
                           {"skipped", client.skipped},
                           {"unsent", client.unsent},
                           {"refined", client.refined},
                           {"bytes", client.bytes},
                           {"failed_updates", client.failed_updates},
                           {"error", client.error},
                           {"camera_to_frame_ms", summaryJson(client.camera_to_frame)}});
    }
    const double frames = static_cast<double>(report.total(&ClientReport::frames));
    return {{"rate_hz", report.schedule.rate_hz},
            {"seconds", report.schedule.measured_s},
            {"warmup_s", report.schedule.warmup_s},
            {"updates", report.total(&ClientReport::updates)},
            {"frames", report.total(&ClientReport::frames)},
            {"skipped", report.total(&ClientReport::skipped)},
            {"unsent", report.total(&ClientReport::unsent)},
            {"refined", report.total(&ClientReport::refined)},
            {"bytes", report.total(&ClientReport::bytes)},
            {"frames_per_second", frames / report.schedule.measured_s},
            {"jain", report.jain},
            {"stages_ms", std::move(stages)},
            {"clients", std::move(clients)}};
}

}  // namespace radiata::client
