#include "io/mesh_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.h"
#include "io/byte_source.h"
#include "model/tractogram.h"

namespace radiata::io {
namespace {

constexpr std::uint64_t kBytesMax = std::uint64_t{1} << 28;
constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;

std::string lowerExtension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

std::string wholeFile(const std::filesystem::path& path) {
    ByteSource source(path, Packing::kPlain, 0);
    if (source.fileBytes() > kBytesMax) {
        throw Error(Code::kResourceExhausted, source.name() + " has " + std::to_string(source.fileBytes()) +
                                                  " bytes; meshes of at most " + std::to_string(kBytesMax) + " are read");
    }
    std::string text(source.fileBytes(), '\0');
    text.resize(source.read(std::as_writable_bytes(std::span(text))));
    return text;
}

bool usable(const glm::vec3& p) {
    return glm::all(glm::lessThanEqual(glm::abs(p), glm::vec3(model::kCoordinateMaxMm)));  // false for NaN
}

/// Words of a text, line by line.
class Lines {
public:
    explicit Lines(std::string_view text) : text_(text) {}
    /// \return  false at the end
    bool next(std::vector<std::string_view>& words) {
        words.clear();
        if (at_ >= text_.size()) return false;
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        std::string_view line = text_.substr(at_, end - at_);
        at_ = end + 1;
        ++number_;
        while (!line.empty()) {
            const std::size_t begin = line.find_first_not_of(" \t\r");
            if (begin == line.npos) break;
            const std::size_t stop = std::min(line.find_first_of(" \t\r", begin), line.size());
            words.push_back(line.substr(begin, stop - begin));
            line.remove_prefix(stop);
        }
        return true;
    }
    std::size_t number() const { return number_; }

private:
    std::string_view text_;
    std::size_t at_ = 0, number_ = 0;
};

template <typename Number>
std::optional<Number> numberOf(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    Number value{};
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failure != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

class Reader {
public:
    Reader(std::string text, std::string name) : text_(std::move(text)) { mesh_.source = std::move(name); }

    model::TriangleMesh readObj() {
        Lines lines(text_);
        std::vector<std::string_view> words;
        while (lines.next(words)) {
            if (words.empty()) continue;
            if (words[0] == "v") mesh_.points.push_back(pointOf(words, lines.number()));
            if (words[0] == "f") addPolygon(words, lines.number());
        }
        return finished();
    }

    model::TriangleMesh readStl() {
        std::uint32_t count = 0;
        if (text_.size() >= kStlHeader) std::memcpy(&count, text_.data() + 80, 4);
        // Binary files may begin with "solid" as well; their size tells.
        if (text_.size() >= kStlHeader && kStlHeader + std::uint64_t{count} * kStlTriangle == text_.size())
            return readBinary(count);
        if (!text_.starts_with("solid")) {
            throw Error(Code::kCorrupt, mesh_.source + ": is no .stl file: it has " + std::to_string(text_.size()) +
                                            " bytes, does not begin with 'solid', and a binary file of the " +
                                            std::to_string(count) + " triangles that it names would have another size");
        }
        Lines lines(text_);
        std::vector<std::string_view> words;
        std::vector<std::uint32_t> corners;
        while (lines.next(words)) {
            if (words.empty() || words[0] != "vertex") continue;
            corners.push_back(merged(pointOf(words, lines.number())));
            if (corners.size() < 3) continue;
            mesh_.triangles.emplace_back(corners[0], corners[1], corners[2]);
            corners.clear();
        }
        if (!corners.empty()) throw Error(Code::kCorrupt, mesh_.source + ": ends within a triangle");
        return finished();
    }

private:
    [[noreturn]] void fail(std::size_t line, const std::string& what) const {
        throw Error(Code::kCorrupt, mesh_.source + ", line " + std::to_string(line) + ": " + what);
    }

    glm::vec3 pointOf(const std::vector<std::string_view>& words, std::size_t line) const {
        glm::vec3 point(0);
        for (int i = 0; i < 3; ++i) {
            const auto number = static_cast<std::size_t>(i + 1) < words.size()
                                    ? numberOf<float>(words[static_cast<std::size_t>(i + 1)])
                                    : std::nullopt;
            if (!number) fail(line, "three numbers are needed after '" + std::string(words[0]) + "'");
            point[i] = *number;
        }
        if (!usable(point)) fail(line, "a coordinate is not finite or farther than 100 m away");
        return point;
    }

    /// "f 1/2/3 -1 4//5": numbers before the first slash, from 1, or from the end if negative.
    void addPolygon(const std::vector<std::string_view>& words, std::size_t line) {
        std::vector<std::uint32_t> corners;
        for (std::size_t i = 1; i < words.size(); ++i) {
            const auto number = numberOf<long long>(words[i].substr(0, words[i].find('/')));
            const auto count = static_cast<long long>(mesh_.points.size());
            const long long index = !number ? -1 : *number < 0 ? count + *number : *number - 1;
            if (index < 0 || index >= count) {
                fail(line, "'" + std::string(words[i].substr(0, 20)) + "' names none of the " + std::to_string(count) +
                               " points before it");
            }
            corners.push_back(static_cast<std::uint32_t>(index));
        }
        if (corners.size() < 3) fail(line, "a face has less than three corners");
        for (std::size_t i = 2; i < corners.size(); ++i) mesh_.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
    }

    model::TriangleMesh readBinary(std::uint32_t count) {
        for (std::uint32_t t = 0; t < count; ++t) {
            std::array<float, 9> corners;
            std::memcpy(corners.data(), text_.data() + kStlHeader + t * kStlTriangle + 12, 36);
            glm::uvec3 triangle(0);
            for (int i = 0; i < 3; ++i) {
                const float* three = &corners[static_cast<std::size_t>(3 * i)];
                const glm::vec3 corner(three[0], three[1], three[2]);
                if (!usable(corner)) {
                    throw Error(Code::kCorrupt, mesh_.source + ": triangle " + std::to_string(t) +
                                                    " has a coordinate that is not finite or farther than 100 m away");
                }
                triangle[i] = merged(corner);
            }
            mesh_.triangles.push_back(triangle);
        }
        return finished();
    }

    std::uint32_t merged(const glm::vec3& p) {
        // 0 and -0 are the same place.
        const std::array<float, 3> key{p.x + 0.0F, p.y + 0.0F, p.z + 0.0F};
        const auto [place, added] = numbers_.try_emplace(key, static_cast<std::uint32_t>(mesh_.points.size()));
        if (added) mesh_.points.push_back(p);
        return place->second;
    }

    /// Triangles without area, two of whose corners are one, are left out: with the edges of their neighbours they close the
    /// surface.
    model::TriangleMesh finished() {
        std::erase_if(mesh_.triangles, [](const glm::uvec3& t) { return t.x == t.y || t.y == t.z || t.z == t.x; });
        if (mesh_.triangles.empty()) throw Error(Code::kCorrupt, mesh_.source + ": has no triangles");
        return std::move(mesh_);
    }

    std::string text_;
    model::TriangleMesh mesh_;
    std::map<std::array<float, 3>, std::uint32_t> numbers_;
};

}  // namespace

bool isMeshName(const std::filesystem::path& path) {
    const std::string extension = lowerExtension(path);
    return extension == ".obj" || extension == ".stl";
}

model::TriangleMesh readMesh(const std::filesystem::path& path) {
    Reader reader(wholeFile(path), path.filename().string());
    return lowerExtension(path) == ".obj" ? reader.readObj() : reader.readStl();
}

}  // namespace radiata::io
