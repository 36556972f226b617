// radiata-phantom: writes a brain-like test image of any size, made from a seed, as a FOD image that every reader of this field
// understands (NIfTI, tournier07 in world axes, as MRtrix3 writes it), with its bundles' ids as labels and names.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "build/phantom.h"
#include "build/phantom_anatomy.h"
#include "build/phantom_tracts.h"
#include "build/stiffness_field.h"
#include "io/nifti_write.h"
#include "io/sh_write.h"
#include "io/tractogram.h"
#include "math/sh_convention.h"
#include "tools/usage.h"

namespace {

using radiata::Code;
using radiata::Error;
using radiata::Phantom;

struct Files {
    std::filesystem::path image, labels, bundles, tracts, anatomy;
    double anatomy_voxel_mm = 1.5;
};

radiata::io::Volume labelVolume(const Phantom& phantom) {
    const radiata::PhantomGrid& grid = phantom.grid();
    const std::vector<std::uint8_t> labels = phantom.labels();
    radiata::io::Volume volume;
    volume.size = {grid.size.x, grid.size.y, grid.size.z, 1};
    volume.voxel_to_world = grid.voxel_to_world;
    volume.source = "labels";
    volume.data.assign(labels.begin(), labels.end());
    return volume;
}

void writeAnatomy(std::uint64_t seed, double voxel_mm, const std::filesystem::path& path) {
    radiata::model::ScalarImage image = radiata::phantomAnatomy(seed, voxel_mm);
    radiata::io::Volume volume;
    volume.size = {image.size.x, image.size.y, image.size.z, 1};
    volume.voxel_to_world = image.voxel_to_world;
    volume.source = image.source;
    volume.data = std::move(image.values);
    radiata::io::writeNifti(volume, path);
}

void writeBundles(const Phantom& phantom, const std::filesystem::path& path) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const radiata::phantom::Bundle& bundle : phantom.field().bundles()) {
        list.push_back({{"id", bundle.id}, {"name", bundle.name}, {"centre_lines", bundle.strands.size()}});
    }
    std::ofstream file(path);
    file << nlohmann::ordered_json{{"seed", phantom.options().seed}, {"bundles", list}}.dump(2) << '\n';
    if (!file.flush()) throw Error(Code::kUnavailable, path.string() + ": cannot be written");
}

/// 21 volumes, as the format voigt-stiffness has them (docs/formats/tensors.md).
void makeStiffness(const radiata::StiffnessOptions& options, const Files& files) {
    const radiata::StiffnessField field = radiata::stiffnessField(options);
    radiata::io::Volume volume;
    const std::size_t voxels = field.matrices.size();
    volume.size = {field.size.x, field.size.y, field.size.z, 21};
    volume.voxel_to_world = field.voxel_to_world;
    volume.source = "stiffness";
    volume.data.resize(voxels * 21);
    for (std::size_t v = 0; v < voxels; ++v) {
        for (std::size_t c = 0; c < 21; ++c) volume.data[c * voxels + v] = static_cast<float>(field.matrices[v][c]);
    }
    radiata::io::writeNifti(volume, files.image);
    std::printf("%s: %d x %d x %d voxels, stiffness tensors of order 4 in GPa, voigt-stiffness, world axes, seed %llu\n",
                files.image.c_str(), field.size.x, field.size.y, field.size.z, static_cast<unsigned long long>(options.seed));
}

/// Said before the work is done, not after.
void checkNiftiName(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    if (!name.ends_with(".nii") && !name.ends_with(".nii.gz")) {
        throw Error(Code::kInvalidArgument, path.string() + ": the name would have to end in .nii or .nii.gz");
    }
    if (path.has_parent_path() && !std::filesystem::is_directory(path.parent_path())) {
        throw Error(Code::kNotFound, path.string() + ": there is no folder " + path.parent_path().string());
    }
}

void writeTracts(const Phantom& phantom, const radiata::PhantomTractOptions& options, const std::filesystem::path& path) {
    radiata::io::writeTractogram(*radiata::phantomTracts(phantom, options), path);
    std::printf("%s: %llu streamlines, step %.3g mm, in groups by bundle, seed %llu\n", path.c_str(),
                static_cast<unsigned long long>(options.fibres), options.step_mm,
                static_cast<unsigned long long>(phantom.options().seed));
}

void make(const radiata::PhantomOptions& options, const radiata::PhantomTractOptions& tracts, const Files& files) {
    checkNiftiName(files.image);
    if (!files.tracts.empty()) radiata::io::requireWritableName(files.tracts);
    if (!files.labels.empty()) checkNiftiName(files.labels);
    if (!files.anatomy.empty()) checkNiftiName(files.anatomy);
    const Phantom phantom(options);
    const radiata::model::ShImage image = phantom.shImage();
    radiata::io::writeNifti(radiata::io::shVolume(image, radiata::ShConvention::kTournier07), files.image);
    if (!files.labels.empty()) radiata::io::writeNifti(labelVolume(phantom), files.labels);
    if (!files.anatomy.empty()) writeAnatomy(options.seed, files.anatomy_voxel_mm, files.anatomy);
    if (!files.bundles.empty()) writeBundles(phantom, files.bundles);
    if (!files.tracts.empty()) writeTracts(phantom, tracts, files.tracts);
    std::printf("%s: %d x %d x %d voxels of %.3g mm, %zu with a glyph, even bands to %d, tournier07, world axes, seed %llu\n",
                files.image.c_str(), image.size.x, image.size.y, image.size.z, image.voxel_to_world[0][0], image.voxels.size(),
                image.layout.lmax, static_cast<unsigned long long>(options.seed));
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Makes a brain-like test image of known fibre bundles from a seed.", "radiata-phantom");
    radiata::PhantomOptions options;
    radiata::PhantomTractOptions tracts;
    Files files;
    app.add_option("output", files.image, "FOD image to write, .nii or .nii.gz")->required();
    app.add_option("--seed", options.seed, "same seed, same bytes")->capture_default_str()->check(CLI::NonNegativeNumber);
    auto* size = app.add_option("--size", options.size, "voxels along the longest axis")->capture_default_str();
    auto* voxel = app.add_option("--voxel", options.voxel_mm, "edge of a voxel in mm, instead of --size")->excludes(size);
    bool stiffness = false;
    auto* brick = app.add_flag("--stiffness", stiffness,
                               "write a brick of fibre-reinforced material instead: elasticity tensors of order 4, 21 volumes")
                      ->excludes(voxel);
    app.add_option("--slice-dense", options.slice_glyphs, "one axial slice with at least so many glyphs")
        ->check(CLI::Range(1, 1000000))
        ->excludes(size)
        ->excludes(voxel)
        ->excludes(brick);
    app.add_option("--lmax", options.lmax, "highest band, even, 0 to 16")->capture_default_str()->excludes(brick);
    app.add_option("--noise", options.noise, "standard deviation added to each coefficient")
        ->capture_default_str()
        ->excludes(brick);
    app.add_option("--labels", files.labels, "write the id of each voxel's strongest bundle, .nii or .nii.gz")->excludes(brick);
    app.add_option("--bundles", files.bundles, "write ids and names of the bundles as JSON")->excludes(brick);
    auto* lines = app.add_option("--tracts", files.tracts, "write streamlines along the bundles, .trx (with groups) or .tck")
                      ->excludes(brick);
    app.add_option("--fibres", tracts.fibres, "how many streamlines")->capture_default_str()->needs(lines);
    app.add_option("--step", tracts.step_mm, "distance of their points in mm, 0.01 to 10")->capture_default_str()->needs(lines);
    auto* anatomy = app.add_option("--anatomy", files.anatomy,
                                   "write a scalar volume somewhat like a T1 image, for isosurfaces, .nii or .nii.gz")
                        ->excludes(brick);
    app.add_option("--anatomy-voxel", files.anatomy_voxel_mm, "edge of its voxels in mm, 0.25 to 20")
        ->capture_default_str()
        ->needs(anatomy);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return radiata::tools::reportUsage(app, error);
    }
    try {
        if (stiffness) {
            checkNiftiName(files.image);
            makeStiffness({options.seed, size->count() > 0 ? options.size : radiata::StiffnessOptions{}.size}, files);
        } else {
            make(options, tracts, files);
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "radiata-phantom: %s\n", error.what());
        return 1;
    }
    return 0;
}
