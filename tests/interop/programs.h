// Running the peers' programs, and saying which package is missing if one is not there.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace radiata::test {

/// Runs a shell command. \throws std::runtime_error with the command if it does not end with 0
inline void run(const std::string& command) {
    const int status = std::system(command.c_str());
    if (status == -1 || !WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error("failed: " + command);
}

/// \throws std::runtime_error naming the Debian package
inline void requireProgram(const std::string& probe, const std::string& package) {
    if (std::system(("( " + probe + " ) >/dev/null 2>&1").c_str()) != 0) {
        throw std::runtime_error("'" + probe + "' does not work: these tests need Debian's package " + package +
                                 " (apt-get install " + package + ")");
    }
}

inline void requireMrtrix() { requireProgram("mrconvert -version && sh2amp -version", "mrtrix3"); }
inline void requireTeem() { requireProgram("teem-unu about", "teem-apps"); }
inline void requireNibabel() { requireProgram("/usr/bin/python3 -c 'import nibabel'", "python3-nibabel"); }

}  // namespace radiata::test
