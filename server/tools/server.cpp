// radiata-server: keeps datasets on a device, renders what cameras ask for, and streams the pictures.
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "session/stub_backend.h"
#include "session/vulkan_backend.h"
#include "tools/server_options.h"

namespace radiata::tools {
namespace {

/// What draws: a device with its datasets, or the stub.
struct Engine {
    std::unique_ptr<gpu::Device> device;
    std::unique_ptr<store::Store> store;
    std::unique_ptr<render::Renderer> renderer;
    session::Backend backend;
};

void startDevice(Engine& engine, const ProgramOptions& options) {
    if (!options.device.pipeline_cache.empty()) {
        const std::filesystem::path folder = options.device.pipeline_cache.parent_path();
        std::error_code failure;
        if (!folder.empty()) std::filesystem::create_directories(folder, failure);
        if (failure) {
            spdlog::warn(
                "the folder {} cannot be made ({}): compiled pipelines are not kept, so every start takes as long as the "
                "first; --pipeline-cache names another file",
                folder.string(), failure.message());
        }
    }
    engine.device = std::make_unique<gpu::Device>(options.device);
    spdlog::info("device: {}, driver {}", engine.device->info().name, engine.device->info().driver);
    engine.store = std::make_unique<store::Store>(*engine.device, options.sh,
                                                  [](const std::string& sentence) { spdlog::info("{}", sentence); });
    engine.store->setTractCache(options.tract_cache);
    engine.store->setVtkSpace(options.vtk_space);
    engine.store->setLatticeFolder(options.lattice_folder);
    for (const auto& [how, path] : options.tensors) {
        for (const auto& entry : engine.store->add(path, how)) {
            spdlog::info("dataset {}: {}, tensors as {}", entry.id, entry.path.string(), io::name(*how.format));
        }
    }
    for (const std::filesystem::path& path : options.data) {
        for (const store::CatalogEntry& entry : engine.store->add(path))
            spdlog::info("dataset {}: {}", entry.id, entry.path.string());
    }
    engine.renderer = std::make_unique<render::Renderer>(*engine.device, *engine.store, options.settings.limits);
    engine.backend = session::vulkanBackend(*engine.renderer, *engine.store);
    std::string traversals;
    for (const std::string& traversal : engine.backend.traversals) traversals += " " + traversal;
    spdlog::info("traversals that passed the self-test:{}", traversals);
    if (!options.test_pipelines) return;
    std::string pipelines;
    for (const std::string& pipeline : engine.renderer->testFibrePipelines()) pipelines += " " + pipeline;
    spdlog::info("fiblet pipelines that passed it:{}", pipelines);
}

/// Requests that leave the traversal open get the one of the flag.
void preferTraversal(session::Backend& backend, model::Traversal traversal) {
    if (traversal == model::Traversal::kAuto) return;
    backend.render = [render = std::move(backend.render), traversal](std::uint64_t view, const model::FrameRequest& request,
                                                                     int first_sample, int count, const model::Outputs& outputs,
                                                                     const std::atomic<bool>* cancel) {
        model::FrameRequest resolved = request;
        if (resolved.quality.traversal == model::Traversal::kAuto) resolved.quality.traversal = traversal;
        return render(view, resolved, first_sample, count, outputs, cancel);
    };
}

/// Address as clients write it: the port that was asked for as 0 is filled in.
std::string address(const std::string& listen, int port) {
    const std::size_t colon = listen.rfind(':');
    if (listen.starts_with("unix") || colon == std::string::npos) return listen;
    return listen.substr(0, colon) + ":" + std::to_string(port);
}

int serve(const ProgramOptions& options, const sigset_t& signals) {
    Engine engine;
    if (options.stub_render_ms) {
        engine.backend = session::stubBackend(std::chrono::milliseconds(*options.stub_render_ms));
        spdlog::warn("pictures are painted, not rendered (--stub-render); --data and the device are not used");
    } else {
        startDevice(engine, options);
    }
    preferTraversal(engine.backend, options.traversal);
    session::Conductor conductor(engine.backend, options.settings);
    service::Server server(conductor, options.server);
    if (!service::isLoopback(options.server.listen)) {
        spdlog::warn("{} can be reached from other machines, without encryption or login", options.server.listen);
    }
    std::printf("radiata-server listening on %s\n", address(options.server.listen, server.port()).c_str());
    std::fflush(stdout);

    int signal = 0;
    sigwait(&signals, &signal);
    spdlog::info("stopping on signal {}", signal);
    server.stop();
    return 0;
}

int run(int argc, char** argv) {
    int exit_code = 0;
    const std::optional<ProgramOptions> options = parseOptions(argc, argv, exit_code);
    if (!options) return exit_code;
    auto logger = spdlog::stderr_color_mt("radiata-server");
    logger->set_level(spdlog::level::from_str(options->log_level));
    logger->flush_on(spdlog::level::info);
    spdlog::set_default_logger(logger);
    if (options->list_devices) {
        int number = 0;
        for (const std::string& name : gpu::Device::list()) std::printf("%d  %s\n", number++, name.c_str());
        return 0;
    }
    // Before any thread starts, so that all of them leave these signals to sigwait.
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    return serve(*options, signals);
}

}  // namespace
}  // namespace radiata::tools

int main(int argc, char** argv) {
    try {
        return radiata::tools::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "radiata-server: %s\n", error.what());
        return 1;
    }
}
