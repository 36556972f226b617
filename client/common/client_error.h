// How the native programs end when they cannot do what they were asked: one line on stderr and a number that scripts can act
// on.
#pragma once

#include <stdexcept>
#include <string>

namespace grpc {
class Status;
}

namespace radiata::client {

enum class ExitCode {
    kOk = 0,
    kInternal = 1,     ///< our own bug
    kUsage = 2,        ///< wrong options, or a camera file that cannot be read or understood
    kUnreachable = 3,  ///< no server there, not serving in time, or lost under way
    kRefused = 4,      ///< the server said no; its sentence is printed
    kOutput = 5,       ///< a file cannot be written
};

class ClientError : public std::runtime_error {
public:
    ClientError(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ExitCode code() const { return code_; }

private:
    ExitCode code_;
};

/// The error for a call that did not end well: kUnreachable when the server is not there or did not answer in time, else
/// kRefused.
ClientError callError(const grpc::Status& status, const std::string& address);

/// Runs a program's body and turns what it throws into one line on stderr, "PROGRAM: sentence", and the exit code.
int runProgram(const std::string& program, int (*body)(int, char**), int argc, char** argv);

}  // namespace radiata::client
