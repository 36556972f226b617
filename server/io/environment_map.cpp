#include "io/environment_map.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "io/byte_source.h"

// The library is one header; nothing but its reader of Radiance pictures is compiled, for this file alone.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace radiata::io {
namespace {

constexpr std::uint64_t kFileBytesMax = 1ULL << 30;
constexpr std::uint64_t kHeaderBytesMax = 65536;
constexpr int kSideMax = 16384;
/// Far above the sun's in any unit; and its square, as standard errors need it, is still a number of 32 bits.
constexpr float kRadianceMax = 1e15F;
constexpr double kExposureMin = 1e-30;

/// The file's bytes for the library, which takes a file that ends early for one that goes on with whatever memory holds, or
/// with runs of no pixels without end. So beyond the file it gets runs of one pixel, and whatever size the header has is
/// reached.
struct Bytes {
    std::vector<std::byte> all;
    std::size_t at = 0;
    bool cut_short = false;

    static int read(void* self, char* out, int size) {
        Bytes& bytes = *static_cast<Bytes*>(self);
        const std::size_t count = std::min(bytes.all.size() - bytes.at, static_cast<std::size_t>(size));
        // Its buffer of 128 bytes may end with the file; anything else that does is missed.
        std::memcpy(out, bytes.all.data() + bytes.at, count);
        bytes.at += count;
        if (count > 0 && size >= 128) return static_cast<int>(count);
        bytes.cut_short |= count < static_cast<std::size_t>(size);
        std::memset(out + count, 1, static_cast<std::size_t>(size) - count);
        return size;
    }
    static void skip(void* self, int count) { static_cast<Bytes*>(self)->at += static_cast<std::size_t>(std::max(count, 0)); }
    static int end(void* self) { return static_cast<Bytes*>(self)->at >= static_cast<Bytes*>(self)->all.size(); }
};

std::string number(float value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%g", static_cast<double>(value));
    return text;
}

Error corrupt(const ByteSource& file, const std::string& reason) {
    return {Code::kCorrupt, file.name() + ": not a Radiance picture that can be read (" + reason + ")"};
}

/// What the header's lines EXPOSURE= multiplied the pixels by, all together; the library passes over these lines.
/// Source: Ward, "The RADIANCE picture file format".
double exposureOf(const ByteSource& file, const std::vector<std::byte>& bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string_view header = text.substr(0, text.find("\n\n"));
    constexpr std::string_view kName = "EXPOSURE=";
    double exposure = 1;
    for (std::size_t line = header.find('\n'); line != header.npos; line = header.find('\n', line + 1)) {
        if (!header.substr(line + 1).starts_with(kName)) continue;
        std::string_view word = header.substr(line + 1 + kName.size());
        word = word.substr(0, word.find_first_of("\r\n"));
        word.remove_prefix(std::min(word.find_first_not_of(" \t+"), word.size()));
        word = word.substr(0, word.find_last_not_of(" \t") + 1);
        double value = 0;
        const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (failure != std::errc() || end != word.data() + word.size() || !(value > 0) || !std::isfinite(value)) {
            throw corrupt(file, "EXPOSURE is '" + std::string(word) + "'; it must be a number above 0");
        }
        exposure *= value;
    }
    if (!(exposure >= kExposureMin && exposure <= 1 / kExposureMin)) {
        throw Error(Code::kUnsupported, file.name() + ": exposures of " + number(static_cast<float>(exposure)) +
                                            " all together; 1e-30 to 1e30 are read");
    }
    return exposure;
}

/// \param bytes  that the file begins with
glm::ivec2 sizeOf(const ByteSource& file, const std::vector<std::byte>& bytes) {
    if (file.fileBytes() > kFileBytesMax) {
        throw Error(Code::kUnsupported, file.name() + ": " + std::to_string(file.fileBytes()) +
                                            " bytes are too many for an environment map; 1 GiB is the limit");
    }
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    if (!stbi_is_hdr_from_memory(data, size)) throw corrupt(file, "it does not begin with #?RADIANCE or #?RGBE");
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(data, size, &width, &height, &channels)) throw corrupt(file, stbi_failure_reason());
    if (width < 2 || height < 1 || width > kSideMax || height > kSideMax) {
        throw Error(Code::kUnsupported, file.name() + ": a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                                            "; 2x1 to 16384x16384 are read");
    }
    return {width, height};
}

}  // namespace

glm::ivec2 readEnvironmentMapSize(const std::filesystem::path& path) {
    ByteSource file(path);
    std::vector<std::byte> bytes(std::min(file.fileBytes(), kHeaderBytesMax));
    bytes.resize(file.read(bytes));
    return sizeOf(file, bytes);
}

model::EnvironmentMap readEnvironmentMap(const std::filesystem::path& path) {
    ByteSource file(path);
    std::vector<std::byte> bytes(std::min(file.fileBytes(), kFileBytesMax));
    bytes.resize(file.read(bytes));
    glm::ivec2 size = sizeOf(file, bytes);
    // Runs of equal bytes shrink a row to a fiftieth at best; so a small file cannot ask for gigabytes.
    const std::size_t count = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    if (count > bytes.size() * 64) throw corrupt(file, "its header promises more pixels than the file can hold");
    const double exposure = exposureOf(file, bytes);
    Bytes source{std::move(bytes)};
    const stbi_io_callbacks reader{&Bytes::read, &Bytes::skip, &Bytes::end};
    int channels = 0;
    const std::unique_ptr<float, void (*)(void*)> pixels(
        stbi_loadf_from_callbacks(&reader, &source, &size.x, &size.y, &channels, 3), stbi_image_free);
    if (source.cut_short) throw corrupt(file, "it ends before its last pixel");
    if (!pixels) throw corrupt(file, stbi_failure_reason());
    model::EnvironmentMap map{size.x, size.y, {}, file.name(), {}};
    map.pixels.reserve(count);
    for (const float* rgb = pixels.get(); map.pixels.size() < count; rgb += 3) {
        map.pixels.emplace_back(glm::dvec3(rgb[0], rgb[1], rgb[2]) / exposure);
    }
    checkEnvironmentMap(map);
    return map;
}

void checkEnvironmentMap(const model::EnvironmentMap& map) {
    if (std::abs(map.width - 2 * map.height) * 8 > map.width) {
        throw Error(Code::kInvalidArgument, map.source + ": " + std::to_string(map.width) + "x" + std::to_string(map.height) +
                                                " pixels; an environment map is twice as wide as high");
    }
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const float value = map.pixels[i][c];
            if (value >= 0 && value <= kRadianceMax) continue;
            throw Error(Code::kInvalidArgument, map.source + ": pixel (" +
                                                    std::to_string(i % static_cast<std::size_t>(map.width)) + ", " +
                                                    std::to_string(i / static_cast<std::size_t>(map.width)) + ") is " +
                                                    number(value) + "; radiance is 0 to 1e15");
        }
    }
}

}  // namespace radiata::io
