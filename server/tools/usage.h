// How the programs of the server's side answer a command line that they cannot use: one line on stderr, status 2.
#pragma once

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <string>

#include <CLI/CLI.hpp>

namespace radiata::tools {

constexpr int kUsageStatus = 2;

/// Help goes to standard output. \return the status to end with
inline int reportUsage(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::string line = error.what();
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::fprintf(stderr, "%s: %s (--help shows the options)\n", app.get_name().c_str(), line.c_str());
    return kUsageStatus;
}

/// A number in words of digits; unlike CLI::Range it refuses "nan".
inline CLI::Validator numberBetween(double least, double most) {
    const auto check = [least, most](std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most) return {};
        std::ostringstream range;
        range << "is " << text << "; it must be a number from " << least << " to " << most;
        return range.str();
    };
    return CLI::Validator(check, "NUMBER");
}

}  // namespace radiata::tools
