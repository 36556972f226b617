// radiata-lab: what accuracy costs in time. In-process, no gRPC; needs nothing but the Vulkan loader and the C++ runtime.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <CLI/CLI.hpp>

#include "base/error.h"
#include "tools/lab/experiments.h"

using namespace radiata;

namespace {

struct Output {
    std::string json_file, svg_file;
};

void write(const std::string& option, const std::string& name, const std::string& text) {
    std::ofstream file(name);
    file << text;
    file.close();
    if (!file.good()) throw Error(Code::kInvalidArgument, option + ": '" + name + "' cannot be written");
}

/// Said before minutes of measuring, not after.
void requireFolder(const std::string& option, const std::string& name) {
    const std::filesystem::path folder = std::filesystem::path(name).parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder)) {
        throw Error(Code::kInvalidArgument, option + ": there is no folder '" + folder.string() + "'");
    }
}

void write(const Output& output, const lab::Report& report) {
    if (!output.json_file.empty()) write("--json", output.json_file, lab::toJson(report).dump(1) + '\n');
    if (output.svg_file.empty()) return;
    if (report.plots.empty()) {
        throw Error(Code::kInvalidArgument, "--svg: experiment '" + report.experiment + "' has no plot, only tables");
    }
    write("--svg", output.svg_file, lab::svg(report.experiment + ", " + report.device, report.plots));
}

int run(const std::string& name, const gpu::DeviceOptions& device_options, const lab::Options& options, const Output& output,
        bool check) {
    for (const lab::Experiment& experiment : lab::experiments()) {
        if (experiment.name != name) continue;
        requireFolder("--json", output.json_file);
        requireFolder("--svg", output.svg_file);
        gpu::Device device(device_options);
        const lab::Report report = experiment.run(device, options);
        lab::print(report);
        write(output, report);
        if (!check) return 0;
        bool good = report.shortfalls.empty();
        for (const lab::Check& figure : report.checks) good = good && figure.holds();
        return good ? 0 : 1;
    }
    throw Error(Code::kNotFound, "there is no experiment '" + name + "'; radiata-lab list names them");
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Measures what accuracy costs in time."};
    app.require_subcommand(1);
    CLI::App* list = app.add_subcommand("list", "Names the experiments");
    CLI::App* run_command = app.add_subcommand("run", "Runs one experiment");
    std::string name;
    Output output;
    bool check = false;
    gpu::DeviceOptions device_options;
    lab::Options options;
    run_command->add_option("name", name, "Experiment")->required();
    run_command->add_option("--size", options.size, "Height of the picture in pixels")->check(CLI::Range(16, 4096));
    run_command->add_option("--image", options.image, "SH image to measure on; a phantom if absent")->check(CLI::ExistingFile);
    run_command
        ->add_option("--tracts", options.tracts, "Streamlines that fiblet-codec and schertzer-table1 encode and check too")
        ->check(CLI::ExistingFile);
    run_command->add_option("--repeats", options.repeats, "Rounds after warm-up")->check(CLI::Range(1, 1000));
    run_command->add_option("--json", output.json_file, "Writes all values to this file");
    run_command->add_option("--svg", output.svg_file, "Draws the plots into this file");
    run_command->add_option("--device", device_options.device, "Number or part of the name of the device");
    run_command->add_flag("--check", check, "Exit status 1 unless all figures hold at full size, view and repeats");
    CLI11_PARSE(app, argc, argv);
    try {
        if (list->parsed()) {
            for (const lab::Experiment& experiment : lab::experiments()) {
                std::printf("%-22s %s\n", experiment.name.c_str(), experiment.about.c_str());
            }
            return 0;
        }
        return run(name, device_options, options, output, check);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "radiata-lab: %s\n", error.what());
        return 3;
    }
}
