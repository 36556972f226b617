// What the subcommands of radiata-convert share. Each lives in a file of its own and adds itself to the program.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "io/sh_options.h"

namespace radiata::tools {

/// Adds "uncertainty IN OUT": glyphs of uncertainty by the recipe of Peters et al. 2023, Sec. 5.
void addUncertaintyCommand(CLI::App& app);
void addTensorsCommand(CLI::App& app);
/// Adds "tracts IN OUT": streamlines to fiblets (docs/formats/fiblet.md) and back.
void addTractsCommand(CLI::App& app);

/// How an SH image is to be read, as text of options.
struct ShReading {
    std::string convention, axes;
    /// Adds --sh-convention and --sh-axes. The object must outlive the parsing.
    void addOptions(CLI::App& command);
    /// \throws Error(kInvalidArgument) that lists the names
    io::ShOptions options() const;
};

/// \throws Error(kInvalidArgument, kNotFound) for a name or folder that the writer would refuse after all the work
void checkNiftiName(const std::filesystem::path& path);

/// Per cent on standard error, only where a person watches. Thread-safe.
class Progress {
public:
    Progress(std::string what, std::size_t total);
    ~Progress();
    void add(std::size_t done);

private:
    std::string what_;
    std::size_t total_;
    bool watched_;
    std::atomic<std::size_t> done_ = 0;
    std::atomic<int> shown_ = -1;
};

}  // namespace radiata::tools
