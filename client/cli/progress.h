// How far a long command is, on stderr: a bar that redraws itself on a terminal, plain lines in a file or pipe.
#pragma once

#include <chrono>
#include <string>

namespace radiata::client {

class Progress {
public:
    /// \param total  steps, at least 1
    /// \param quiet  say nothing
    Progress(int total, bool quiet);
    /// Ends the bar's line, so that an error that follows stands on its own.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// \param done  steps done, \param what  the latest one
    void step(int done, const std::string& what);

private:
    int total_;
    bool quiet_;
    bool terminal_;
    bool open_line_ = false;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace radiata::client
