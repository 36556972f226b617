#include "gpu/pipeline_cache.h"

#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include "base/error.h"

namespace radiata::gpu {
namespace {

struct FileHeader {
    std::array<char, 8> magic;
    std::uint64_t size;
    std::uint64_t checksum;
};
static_assert(sizeof(FileHeader) == 24);
constexpr std::array<char, 8> kMagic{'R', 'A', 'D', 'P', 'I', 'P', 'E', '1'};
constexpr std::uint64_t kSizeMax = 256ULL << 20;

// FNV-1a: against damage, not against malice.
std::uint64_t checksum(std::span<const std::byte> bytes) {
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const std::byte byte : bytes) hash = (hash ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3ULL;
    return hash;
}

bool isOfDevice(std::span<const std::byte> bytes, const vk::PhysicalDeviceProperties& device) {
    VkPipelineCacheHeaderVersionOne header;
    if (bytes.size() < sizeof header) return false;
    std::memcpy(&header, bytes.data(), sizeof header);
    return header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE && header.vendorID == device.vendorID &&
           header.deviceID == device.deviceID &&
           std::memcmp(header.pipelineCacheUUID, device.pipelineCacheUUID.data(), VK_UUID_SIZE) == 0;
}

}  // namespace

std::vector<std::byte> readPipelineCache(const std::filesystem::path& file, const vk::PhysicalDeviceProperties& device) {
    std::ifstream stream(file, std::ios::binary);
    FileHeader header;
    if (!stream.read(reinterpret_cast<char*>(&header), sizeof header)) return {};
    std::error_code error;
    if (header.magic != kMagic || header.size > kSizeMax ||
        std::filesystem::file_size(file, error) != header.size + sizeof header) {
        return {};
    }
    std::vector<std::byte> bytes(header.size);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) return {};
    if (checksum(bytes) != header.checksum || !isOfDevice(bytes, device)) return {};
    return bytes;
}

void writePipelineCache(const std::filesystem::path& file, std::span<const std::byte> bytes) {
    std::error_code error;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
    const std::filesystem::path temporary = file.string() + "." + std::to_string(::getpid()) + ".tmp";
    {
        std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
        const FileHeader header{kMagic, bytes.size(), checksum(bytes)};
        stream.write(reinterpret_cast<const char*>(&header), sizeof header);
        stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        stream.flush();
        if (!stream) error = std::make_error_code(std::errc::io_error);
    }
    if (!error) std::filesystem::rename(temporary, file, error);
    if (error) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw Error(Code::kUnavailable, "pipeline cache '" + file.string() + "' could not be written: " + error.message());
    }
}

}  // namespace radiata::gpu
