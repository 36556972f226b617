// radiata-convert uncertainty: a second glyph for each voxel by the recipe of Peters et al. 2023, Sec. 5, for data whose
// uncertainty was not measured. The output has the grid, bands, convention and axes of the input.
#include <cinttypes>
#include <cstdio>
#include <memory>

#include "base/error.h"
#include "build/uncertain_glyphs.h"
#include "io/nifti_write.h"
#include "io/sh_image.h"
#include "io/sh_write.h"
#include "tools/convert.h"

namespace radiata::tools {
namespace {

struct Options {
    std::filesystem::path input, output;
    ShReading reading;
    UncertaintyRecipe recipe;
};

void convert(const Options& options) {
    checkNiftiName(options.output);
    std::error_code failure;
    if (std::filesystem::equivalent(options.input, options.output, failure)) {
        throw Error(Code::kInvalidArgument, options.output.string() + ": input and output are the same file");
    }
    const model::ShImage image = io::readShImage(options.input, options.reading.options());
    model::ShImage uncertain;
    {
        Progress progress("varying glyphs", image.voxels.size());
        uncertain = uncertaintyByRecipe(image, options.recipe, [&](std::size_t done) { progress.add(done); });
    }
    io::writeNifti(io::shVolume(uncertain, image.file_convention, image.file_axes), options.output);
    std::printf("%s: uncertainty of %zu glyphs, constant part times %g, deviation %g, seed %" PRIu64 ", %s, %s axes\n",
                options.output.c_str(), uncertain.voxels.size(), options.recipe.constant, options.recipe.deviation,
                options.recipe.seed, std::string(name(image.file_convention)).c_str(),
                std::string(name(image.file_axes)).c_str());
}

}  // namespace

void addUncertaintyCommand(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("uncertainty", "Makes glyphs of uncertainty for an SH image that has none measured");
    command->add_option("input", options->input, "SH image: .nii, .nii.gz, .mif, .mif.gz or .mih")->required();
    command->add_option("output", options->output, "SH image to write, .nii or .nii.gz")->required();
    command->add_option("--constant", options->recipe.constant, "Factor of the constant part, 0 to 100")->capture_default_str();
    command->add_option("--deviation", options->recipe.deviation, "Standard deviation of each coefficient's factor, 0 to 100")
        ->capture_default_str();
    command->add_option("--seed", options->recipe.seed, "Same seed, same bytes")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    options->reading.addOptions(*command);
    command->callback([options] { convert(*options); });
}

}  // namespace radiata::tools
