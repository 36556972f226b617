// radiata-convert tensors: an image of Cartesian tensors as the spherical-harmonics image of the same functions, exactly but
// for one rounding to float, in world axes.
#include <cstdio>
#include <memory>

#include "base/error.h"
#include "io/nifti_write.h"
#include "io/sh_write.h"
#include "io/tensor_image.h"
#include "tools/convert.h"

namespace radiata::tools {
namespace {

struct Options {
    std::filesystem::path input, output;
    std::string format, axes, convention = "tournier07";
};

void convert(const Options& options) {
    checkNiftiName(options.output);
    std::error_code failure;
    if (std::filesystem::equivalent(options.input, options.output, failure)) {
        throw Error(Code::kInvalidArgument, options.output.string() + ": input and output are the same file");
    }
    const ShConvention convention = shConventionFromName(options.convention);
    io::TensorOptions how;
    if (!options.format.empty()) how.format = io::tensorFormatFromName(options.format);
    if (!options.axes.empty()) how.axes = shAxesFromName(options.axes);
    const model::ShImage image = io::readTensorImage(options.input, how);
    io::writeNifti(io::shVolume(image, convention, ShAxes::kWorld), options.output);
    std::printf("%s: %zu tensors of order %d, read as %s, as %s bands to %d, %s, world axes\n", options.output.c_str(),
                image.voxels.size(), image.tensor_order, image.tensor_format.c_str(), image.layout.full ? "full" : "even",
                image.layout.lmax, options.convention.c_str());
}

}  // namespace

void addTensorsCommand(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("tensors", "Writes Cartesian tensors of order 2 to 12 as spherical harmonics");
    command->add_option("input", options->input, "Tensor image: .nii, .nii.gz, .mif, .mif.gz or .mih")->required();
    command->add_option("output", options->output, "SH image to write, .nii or .nii.gz")->required();
    command->add_option(
        "--format", options->format,
        "mrtrix, dipy, fsl, voigt-stiffness, voigt-compliance, mandel, symmetric or entries; may be left out where "
        "the header says it");
    command->add_option("--tensor-axes", options->axes,
                        "Axes of the tensors' directions, where not the format's: world, voxel");
    command->add_option("--sh-convention", options->convention, "Convention to write")->capture_default_str();
    command->callback([options] { convert(*options); });
}

}  // namespace radiata::tools
