// The one exception type. A message is a sentence for people: what, where, the value, and what would be right.
#pragma once

#include <stdexcept>
#include <string>

namespace radiata {

enum class Code {
    kInvalidArgument,    ///< the caller asked for something that can never work
    kNotFound,           ///< no such dataset, view or file
    kCorrupt,            ///< a file contradicts itself or its format
    kUnsupported,        ///< valid, but not something this program or device does
    kResourceExhausted,  ///< over a limit of size, memory or count
    kUnavailable,        ///< works again later (device busy or lost, server stopping)
    kCancelled,          ///< nobody waits for the answer any more
    kInternal,           ///< our own bug
};

class Error : public std::runtime_error {
public:
    Error(Code code, const std::string& message) : std::runtime_error(message), code_(code) {}
    Code code() const { return code_; }

private:
    Code code_;
};

}  // namespace radiata
