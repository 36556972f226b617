#include "io/scalar_image.h"

#include <limits>

#include "base/error.h"
#include "io/volume.h"

namespace radiata::io {

model::ScalarImage readScalarImage(const std::filesystem::path& path) {
    Volume volume = readVolume(path);
    if (volume.size[3] != 1) {
        throw Error(Code::kCorrupt,
                    volume.source + ": the image has " + std::to_string(volume.size[3]) + " volumes; a scalar volume has 1");
    }
    model::ScalarImage image;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t length = volume.size[static_cast<std::size_t>(axis)];
        if (length > std::numeric_limits<int>::max()) {
            throw Error(Code::kResourceExhausted, volume.source + ": axis " + std::to_string(axis + 1) + " has " +
                                                      std::to_string(length) + " voxels; at most 2147483647 are read");
        }
        image.size[axis] = static_cast<int>(length);
    }
    image.voxel_to_world = volume.voxel_to_world;
    image.values = std::move(volume.data);
    image.source = std::move(volume.source);
    return image;
}

}  // namespace radiata::io
