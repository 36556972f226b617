// Any bytes given to the image readers as a file: they either read it or throw Error, and what they read is consistent.
// The name of the file (RADIATA_FUZZ_FILE) chooses the format; data.dat stands beside it for .mih headers to name.
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.h"
#include "io/sh_image.h"
#include "io/stored_image.h"
#include "io/tensor_image.h"
#include "io/volume.h"

namespace {

/// The folder of this process' input file; removed at exit.
class Folder {
public:
    Folder() : path_(std::filesystem::temp_directory_path() / ("radiata_fuzz_" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(path_);
        std::ofstream(path_ / "data.dat", std::ios::binary) << std::string(4096, '\x3f');
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

const std::filesystem::path& folder() {
    static const Folder kFolder;
    return kFolder.path();
}

void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "broken: %s\n", what);
    std::abort();
}

void readVolume(const std::filesystem::path& path) {
    try {
        const radiata::io::StoredImage stored = radiata::io::readStoredImage(path);
        require(std::filesystem::canonical(stored.data_path).parent_path() == std::filesystem::canonical(folder()),
                "data are read from the header's folder only");
        const radiata::io::Volume volume = radiata::io::readVolume(path);
        std::uint64_t count = 1;
        for (const std::int64_t length : volume.size) count *= static_cast<std::uint64_t>(length);
        require(count == volume.data.size(), "as many samples as the size says");
    } catch (const radiata::Error& error) {
        require(error.code() != radiata::Code::kInternal, "no input is a bug of ours");
    }
}

void readShImage(const std::filesystem::path& path, const radiata::io::ShOptions& options) {
    try {
        const radiata::model::ShImage image = radiata::io::readShImage(path, options);
        require(image.coefficients.size() == image.voxels.size() * image.layout.count(), "coefficients for each voxel");
        for (const glm::ivec3& voxel : image.voxels) {
            for (int axis = 0; axis < 3; ++axis) require(voxel[axis] >= 0 && voxel[axis] < image.size[axis], "voxel in grid");
        }
        require(!radiata::io::describe(image).empty(), "a description");
    } catch (const radiata::Error& error) {
        require(error.code() != radiata::Code::kInternal, "no input is a bug of ours");
    }
}

void readTensorImage(const std::filesystem::path& path, const radiata::io::TensorOptions& options) {
    try {
        const radiata::model::ShImage image = radiata::io::readTensorImage(path, options);
        const auto n = static_cast<std::size_t>(image.tensor_order);
        require(image.tensors.size() == image.voxels.size() * (n + 1) * (n + 2) / 2, "components for each voxel");
        require(image.coefficients.size() == image.voxels.size() * image.layout.count(), "coefficients for each voxel");
    } catch (const radiata::Error& error) {
        require(error.code() != radiata::Code::kInternal, "no input is a bug of ours");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::filesystem::path path = folder() / RADIATA_FUZZ_FILE;
    {
        std::ofstream file(path, std::ios::binary | std::ios::trunc);
        file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    }
    readVolume(path);
    readShImage(path, {});
    readShImage(path, {radiata::ShConvention::kMrtrix02, radiata::ShAxes::kVoxel, true});
    using radiata::io::TensorFormat;
    for (const TensorFormat format :
         {TensorFormat::kFsl, TensorFormat::kMandel, TensorFormat::kSymmetric, TensorFormat::kEntries}) {
        readTensorImage(path, {format, {}});
    }
    readTensorImage(path, {});
    return 0;
}
