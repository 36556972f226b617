// radiata: asks a Radiata server for its catalogue and for pictures. docs/formats/camera.md describes the camera files.
// Exit codes: 0 well, 2 usage, 3 server not reachable, 4 request refused, 5 output cannot be written; errors are one line on
// stderr.
#include <iostream>

#include "cli/commands.h"
#include "common/client_error.h"

namespace {

int body(int argc, char** argv) {
    CLI::App app("Client of a Radiata server. Pictures are not for diagnostic use.", "radiata");
    radiata::client::ConnectionOptions connection;
    radiata::client::addConnectionOptions(app, connection);
    app.require_subcommand(0, 1);
    app.fallthrough();
    app.footer("Exit codes: 0 well, 2 usage, 3 server not reachable, 4 request refused, 5 output cannot be written.");
    radiata::client::addCatalogCommands(app, connection);
    radiata::client::addRenderCommand(app, connection);
    radiata::client::addOrbitCommand(app, connection);
    radiata::client::addPickCommand(app, connection);
    radiata::client::addLassoCommand(app, connection);
    radiata::client::addSelectCommand(app, connection);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        return app.exit(help);
    }
    // Asked for here, because CLI11 would not name a misspelt command.
    if (app.get_subcommands().empty()) {
        throw radiata::client::ClientError(radiata::client::ExitCode::kUsage, "a command is needed; --help lists them");
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return radiata::client::runProgram("radiata", body, argc, argv); }
