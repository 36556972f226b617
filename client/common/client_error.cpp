#include "common/client_error.h"

#include <algorithm>
#include <iostream>

#include <grpcpp/grpcpp.h>
#include <CLI/CLI.hpp>

#include "base/error.h"

namespace radiata::client {
namespace {

int report(const std::string& program, const std::string& message, ExitCode code) {
    // Servers and parsers may send line breaks; an error is one line.
    std::string line = message;
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    std::cerr << program << ": " << line << std::endl;
    return static_cast<int>(code);
}

std::string codeName(grpc::StatusCode code) {
    switch (code) {
        case grpc::StatusCode::INVALID_ARGUMENT:
            return "invalid argument";
        case grpc::StatusCode::NOT_FOUND:
            return "not found";
        case grpc::StatusCode::RESOURCE_EXHAUSTED:
            return "over a limit";
        case grpc::StatusCode::UNIMPLEMENTED:
            return "not supported";
        case grpc::StatusCode::FAILED_PRECONDITION:
            return "failed precondition";
        case grpc::StatusCode::DATA_LOSS:
            return "corrupt data";
        case grpc::StatusCode::CANCELLED:
            return "cancelled";
        case grpc::StatusCode::INTERNAL:
            return "internal error";
        default:
            return "status " + std::to_string(static_cast<int>(code));
    }
}

}  // namespace

ClientError callError(const grpc::Status& status, const std::string& address) {
    if (status.error_code() == grpc::StatusCode::UNAVAILABLE) {
        return {ExitCode::kUnreachable, "server " + address + " is not available: " + status.error_message()};
    }
    if (status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED) {
        return {ExitCode::kUnreachable, "server " + address + " did not answer in time; --timeout sets how long to wait"};
    }
    return {ExitCode::kRefused, "refused (" + codeName(status.error_code()) + "): " + status.error_message()};
}

int runProgram(const std::string& program, int (*body)(int, char**), int argc, char** argv) {
    try {
        return body(argc, argv);
    } catch (const ClientError& error) {
        return report(program, error.what(), error.code());
    } catch (const CLI::ParseError& error) {
        return report(program, std::string(error.what()) + " (--help shows the options)", ExitCode::kUsage);
    } catch (const Error& error) {
        const bool usage = error.code() == Code::kInvalidArgument;
        return report(program, error.what(), usage ? ExitCode::kUsage : ExitCode::kInternal);
    } catch (const std::exception& error) {
        return report(program, error.what(), ExitCode::kInternal);
    }
}

}  // namespace radiata::client
