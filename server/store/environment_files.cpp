#include "store/environment_files.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include <zlib.h>

#include "base/error.h"
#include "build/light_harmonics.h"
#include "io/environment_map.h"

namespace radiata::store {

bool isEnvironmentName(const std::filesystem::path& path) { return path.extension() == ".hdr"; }

std::shared_ptr<const model::EnvironmentMap> loadEnvironment(const std::filesystem::path& path) {
    return completeEnvironment(io::readEnvironmentMap(path));
}

std::shared_ptr<const model::EnvironmentMap> completeEnvironment(model::EnvironmentMap map) {
    io::checkEnvironmentMap(map);
    map.harmonics = environmentHarmonics(map);
    const auto pixels = std::as_bytes(std::span(map.pixels));
    map.check = static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(pixels.data()), pixels.size()));
    return std::make_shared<const model::EnvironmentMap>(std::move(map));
}

model::DatasetInfo environmentInfo(const std::string& id, const model::EnvironmentMap& map) {
    model::DatasetInfo info;
    info.id = id;
    info.kind = model::DatasetKind::kEnvironmentMap;
    info.size = {map.width, map.height, 1};
    info.value_min = std::numeric_limits<float>::infinity();
    for (const glm::vec3& pixel : map.pixels) {
        const float luminance = glm::dot(pixel, glm::vec3(0.2126F, 0.7152F, 0.0722F));
        info.value_min = std::min(info.value_min, luminance);
        info.value_max = std::max(info.value_max, luminance);
    }
    return info;
}

model::DatasetInfo environmentHeaderInfo(const std::string& id, const std::filesystem::path& path) {
    model::DatasetInfo info;
    info.id = id;
    info.kind = model::DatasetKind::kEnvironmentMap;
    try {
        info.size = glm::ivec3(io::readEnvironmentMapSize(path), 1);
    } catch (const Error&) {
        // The list goes on; whoever asks for this map gets the reader's sentence.
    }
    return info;
}

}  // namespace radiata::store
