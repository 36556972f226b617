#include "ingest/fiblet_runs.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <span>
#include <utility>

#include <zlib.h>

#include "build/fiblet_pages.h"

namespace radiata::ingest {
namespace {

constexpr std::size_t kBuffer = 1 << 16;
constexpr std::array<char, 8> kMagic{'F', 'I', 'B', 'R', 'U', 'N', 'S', '1'};

std::uint32_t crcOf(std::span<const std::byte> bytes, std::uint32_t before = 0) {
    // Nothing may be at no address, for which zlib begins anew.
    if (bytes.empty()) return before;
    return std::uint32_t(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

template <typename T>
std::span<const std::byte> bytesOf(const T& value) {
    return std::as_bytes(std::span(&value, 1));
}

}  // namespace

/// Of the file; the key's bytes follow.
struct FibletRuns::Head {
    std::array<char, 8> magic = kMagic;
    std::uint32_t crc = 0;  ///< of this with 0 here, and of the key
    std::uint32_t key_bytes = 0;
    shader::FibletCodec codec{};
    std::uint32_t walked = 0, reserved = 0;
    double origin_mm[3]{}, walk_step_mm = 0, walk_mean_um = 0, walk_max_um = 0;
    std::uint64_t walk_points = 0;
};

struct FibletRuns::RunHead {
    std::uint32_t crc = 0;  ///< of this with 0 here, and of all content
    std::uint32_t reserved = 0;
    std::uint64_t bytes = 0, column_bytes = 0;  ///< of all content, and of its last part
    RunSums sums;
};

void RunSums::add(const RunSums& other) {
    fibres += other.fibres;
    fiblets += other.fiblets;
    words += other.words;
    points += other.points;
    measured += other.measured;
    sum_error_nm += other.sum_error_nm;
    max_error_mm = std::max(max_error_mm, other.max_error_mm);
}

std::uint64_t Run::bytes() const {
    std::uint64_t sum = block.fiblets.size() * (sizeof(LooseFiblet) + sizeof(OrderedFiblet) + 72 * block.ranges.size()) +
                        4 * block.heap.size() + 4 * fiblets.size();
    for (const auto& column : fibre_columns) sum += 4 * column.size();
    return sum;
}

FibletRuns::FibletRuns(std::filesystem::path path, std::string key, std::size_t point_columns)
    : file_(std::move(path)), key_(std::move(key)), point_columns_(point_columns) {
    if (!readHead()) return;
    while (readRun()) continue;
    file_.cut(end_);
}

bool FibletRuns::readHead() {
    Head head;
    if (file_.read(0, std::as_writable_bytes(std::span(&head, 1))) < sizeof head || head.magic != kMagic ||
        head.key_bytes != key_.size())
        return false;
    std::string key(head.key_bytes, ' ');
    file_.read(sizeof head, std::as_writable_bytes(std::span(key)));
    const std::uint32_t crc = std::exchange(head.crc, 0);
    if (key != key_ || crc != crcOf(std::as_bytes(std::span(key)), crcOf(bytesOf(head)))) return false;
    plan_.set.codec = head.codec;
    plan_.set.origin_mm = {head.origin_mm[0], head.origin_mm[1], head.origin_mm[2]};
    plan_.set.walked = head.walked != 0;
    plan_.set.walk_errors = {head.walk_mean_um, head.walk_max_um, head.walk_points};
    plan_.walk_step_mm = head.walk_step_mm;
    end_ = sizeof head + key_.size();
    planned_ = true;
    return true;
}

bool FibletRuns::readRun() {
    RunHead head;
    if (file_.read(end_, std::as_writable_bytes(std::span(&head, 1))) < sizeof head) return false;
    const std::uint64_t first = end_ + sizeof head, bytes = file_.bytes();
    if (head.bytes > bytes - first) return false;
    const std::uint32_t expected = std::exchange(head.crc, 0);
    std::uint32_t crc = crcOf(bytesOf(head));
    std::vector<std::byte> part(16 * kBuffer);
    for (std::uint64_t at = 0; at < head.bytes; at += part.size()) {
        const auto own = std::span(part).first(std::min<std::uint64_t>(part.size(), head.bytes - at));
        if (file_.read(first + at, own) < own.size()) return false;
        crc = crcOf(own, crc);
    }
    if (crc != expected) return false;
    note(head);
    return true;
}

void FibletRuns::note(const RunHead& head) {
    StoredRun run;
    run.sums = head.sums;
    run.records = end_ + sizeof head;
    run.end = run.records + head.bytes;
    run.columns = run.end - head.column_bytes;
    run.fiblets = run.columns - 4 * head.sums.fibres;
    run.numbers = run.fiblets - 4 * head.sums.fiblets;
    runs_.push_back(run);
    sums_.add(run.sums);
    end_ = run.end;
}

bool FibletRuns::plan(FibletPlan& plan) const {
    if (!planned_) return false;
    plan.set.codec = plan_.set.codec;
    plan.set.origin_mm = plan_.set.origin_mm;
    plan.set.walked = plan_.set.walked;
    plan.set.walk_errors = plan_.set.walk_errors;
    plan.walk_step_mm = plan_.walk_step_mm;
    return true;
}

void FibletRuns::begin(const FibletPlan& plan) {
    Head head;
    head.key_bytes = std::uint32_t(key_.size());
    head.codec = plan.set.codec;
    head.walked = plan.set.walked ? 1 : 0;
    for (int axis = 0; axis < 3; ++axis) head.origin_mm[axis] = plan.set.origin_mm[axis];
    head.walk_step_mm = plan.walk_step_mm;
    head.walk_mean_um = plan.set.walk_errors.mean_um;
    head.walk_max_um = plan.set.walk_errors.max_um;
    head.walk_points = plan.set.walk_errors.points;
    head.crc = crcOf(std::as_bytes(std::span(key_)), crcOf(bytesOf(head)));
    file_.cut(0);
    file_.write(0, bytesOf(head));
    file_.write(sizeof head, std::as_bytes(std::span(key_)));
    end_ = sizeof head + key_.size();
}

void FibletRuns::append(std::span<const std::byte> bytes) {
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    if (buffer_.size() >= kBuffer) flush();
}

void FibletRuns::flush() {
    file_.write(written_, buffer_);
    crc_ = crcOf(buffer_, crc_);
    written_ += buffer_.size();
    buffer_.clear();
}

void FibletRuns::add(const Run& run, const shader::FibletCodec& codec) {
    const FibletBlock& block = run.block;
    RunHead head;
    head.sums = {run.fiblets.size(), block.fiblets.size(), block.heap.size(), block.points,
                 block.measured,     block.sum_error_nm,   block.max_error_mm};
    for (const auto& column : run.fibre_columns) head.column_bytes += 4 * column.size();
    head.bytes = block.fiblets.size() * (8 + sizeof(model::FibletHead) + 72 * point_columns_ + 4) + 4 * block.heap.size() +
                 4 * run.fiblets.size() + head.column_bytes;
    const std::vector<OrderedFiblet> order = orderFiblets(block.fiblets, block.heap, codec);
    crc_ = crcOf(bytesOf(head));
    written_ = end_ + sizeof head;
    buffer_.clear();
    for (const OrderedFiblet& next : order) {
        const LooseFiblet& fiblet = block.fiblets[next.number];
        append(bytesOf(next.morton));
        append(bytesOf(fiblet.head));
        append(std::as_bytes(std::span(block.heap).subspan(fiblet.first_word, wordsOf(fiblet.head))));
        for (std::size_t c = 0; c < point_columns_; ++c) {
            append(bytesOf(block.ranges[c][next.number]));
            append(std::as_bytes(std::span(block.values[c]).subspan(64UL * next.number, 64)));
        }
    }
    for (const OrderedFiblet& next : order) append(bytesOf(next.number));
    append(std::as_bytes(std::span(run.fiblets)));
    for (const auto& column : run.fibre_columns) append(std::as_bytes(std::span(column)));
    flush();
    // The head comes last: what is there without it was not completed.
    head.crc = crc_;
    file_.write(end_, bytesOf(head));
    note(head);
}

}  // namespace radiata::ingest
