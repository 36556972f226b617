#include "io/volume.h"

#include "io/stored_image.h"

namespace radiata::io {

Volume readVolume(const std::filesystem::path& path) {
    const StoredImage image = readStoredImage(path);
    return {image.size, image.voxel_to_world, readSamples(image), path.filename().string()};
}

}  // namespace radiata::io
