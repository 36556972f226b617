// Fiblets on the way to a file: runs of consecutive fibres, each sorted by its fiblets' places and complete with a checksum, in
// a scratch file. Whoever finds such a file goes on after its last complete run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "build/fiblet_block.h"
#include "build/fiblet_encode.h"
#include "ingest/scratch_file.h"

namespace radiata::ingest {

/// Sums over fibres.
struct RunSums {
    std::uint64_t fibres = 0, fiblets = 0, words = 0, points = 0, measured = 0, sum_error_nm = 0;
    double max_error_mm = 0;

    void add(const RunSums& other);
};

/// Consecutive fibres, encoded.
struct Run {
    FibletBlock block;
    std::vector<std::uint32_t> fiblets;             ///< of each fibre
    std::vector<std::vector<float>> fibre_columns;  ///< of each column: fibres * components

    std::uint64_t bytes() const;
};

/// Where the parts of a run are in the file.
struct StoredRun {
    RunSums sums;
    std::uint64_t records = 0;  ///< sorted: uint64 Morton code, head, codes, for each point column low, high and 64 values
    std::uint64_t numbers = 0;  ///< uint32 for each record: its place among the run's fiblets in the order of their fibres
    std::uint64_t fiblets = 0;  ///< uint32 for each fibre
    std::uint64_t columns = 0;  ///< floats, column after column
    std::uint64_t end = 0;
};

class FibletRuns {
public:
    /// \param key  text that says which input and which settings the runs are of; runs of others are thrown away
    FibletRuns(std::filesystem::path path, std::string key, std::size_t point_columns);

    /// The plan of the runs that are there; false if there are none to continue.
    bool plan(FibletPlan& plan) const;
    void begin(const FibletPlan& plan);
    /// Sorts and writes it. \throws Error(kUnavailable), the runs before being kept
    void add(const Run& run, const shader::FibletCodec& codec);

    const std::vector<StoredRun>& runs() const { return runs_; }
    const RunSums& sums() const { return sums_; }
    ScratchFile& file() { return file_; }
    std::size_t pointColumns() const { return point_columns_; }
    /// Behind the last complete run.
    std::uint64_t end() const { return end_; }

private:
    struct Head;
    struct RunHead;
    bool readHead();
    bool readRun();
    void note(const RunHead& head);
    void append(std::span<const std::byte> bytes);
    void flush();

    ScratchFile file_;
    std::string key_;
    std::size_t point_columns_;
    FibletPlan plan_;
    bool planned_ = false;
    std::vector<StoredRun> runs_;
    RunSums sums_;
    std::uint64_t end_ = 0;

    std::vector<std::byte> buffer_;
    std::uint64_t written_ = 0;
    std::uint32_t crc_ = 0;
};

}  // namespace radiata::ingest
