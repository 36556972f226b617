#include "store/lattice_files.h"

#include <array>
#include <charconv>
#include <cstdint>

namespace radiata::store {

std::filesystem::path latticePath(const std::filesystem::path& dataset, const std::filesystem::path& folder,
                                  const std::string& key) {
    if (dataset.empty()) return {};
    // FNV-1a (Fowler, Noll, Vo).
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const char c : key) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 0x100000001b3ULL;
    }
    std::array<char, 16> digits{};
    const std::string hex(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), hash, 16).ptr);
    const std::filesystem::path place = folder.empty() ? dataset.parent_path() : folder;
    return place / (dataset.filename().string().substr(0, 100) + "-" + hex + ".lattice");
}

}  // namespace radiata::store
