#include "io/vtk_sections.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <map>

#include "base/checked.h"
#include "base/error.h"
#include "io/text.h"

namespace radiata::io {
namespace {

constexpr std::size_t kLineMax = 4096, kBlockNumbers = std::size_t{1} << 16;

std::optional<SampleType> typeNamed(const std::string& name) {
    static const std::map<std::string, SampleType> kTypes{
        {"char", SampleType::kInt8},          {"unsigned_char", SampleType::kUInt8},
        {"short", SampleType::kInt16},        {"unsigned_short", SampleType::kUInt16},
        {"int", SampleType::kInt32},          {"unsigned_int", SampleType::kUInt32},
        {"long", SampleType::kInt64},         {"unsigned_long", SampleType::kUInt64},
        {"vtktypeint64", SampleType::kInt64}, {"vtktypeuint64", SampleType::kUInt64},
        {"vtkIdType", SampleType::kInt32},    {"float", SampleType::kFloat32},
        {"double", SampleType::kFloat64},     {"bit", SampleType::kBit},
    };
    const auto found = kTypes.find(name);
    if (found == kTypes.end()) return std::nullopt;
    return found->second;
}

/// Reads the keywords of a file and steps over the numbers between them.
class Scanner {
public:
    explicit Scanner(const std::filesystem::path& path) : source_(path) {}

    VtkSections scan() {
        const std::string magic = line();
        if (!magic.starts_with("# vtk DataFile")) fail(shown(magic) + " where '# vtk DataFile Version' should be");
        sections_.title = line();
        const std::string kind = line();
        if (kind != "ASCII" && kind != "BINARY") fail(shown(kind) + " where ASCII or BINARY should be");
        sections_.text = kind == "ASCII";
        while (keyword()) continue;
        if (!sections_.points) fail("no POINTS in the file");
        if (!sections_.cells && !sections_.ids) fail("no LINES in the file");
        return std::move(sections_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(Code::kCorrupt, source_.name() + ": before byte " + std::to_string(source_.position()) + ": " + what);
    }

    bool take(char& c) { return source_.read(std::as_writable_bytes(std::span(&c, 1))) == 1; }

    /// The next line without its end; empty lines and the end of the file give an empty one.
    std::string line() {
        std::string text;
        for (char c = 0; text.size() < kLineMax && take(c) && c != '\n';) text += c;
        if (text.size() == kLineMax) fail("a line of more than 4096 characters where a keyword should be");
        while (!text.empty() && (text.back() == '\r' || text.back() == ' ' || text.back() == '\t')) text.pop_back();
        return text;
    }

    std::vector<std::string> words(const std::string& text) const {
        std::vector<std::string> parts;
        for (std::size_t at = text.find_first_not_of(" \t"); at != text.npos; at = text.find_first_not_of(" \t", at)) {
            const std::size_t end = std::min(text.find_first_of(" \t", at), text.size());
            parts.push_back(text.substr(at, end - at));
            at = end;
        }
        return parts;
    }

    std::uint64_t whole(const std::vector<std::string>& parts, std::size_t i) const {
        std::uint64_t value = 0;
        const std::string text = i < parts.size() ? parts[i] : "";
        const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (failure != std::errc() || text.empty() || end != text.data() + text.size() || value >> 48 != 0) {
            fail(shown(text) + " where a count should be, after " + (parts.empty() ? "" : parts[0]));
        }
        return value;
    }

    SampleType type(const std::vector<std::string>& parts, std::size_t i) const {
        const std::string name = i < parts.size() ? parts[i] : "";
        const std::optional<SampleType> found = typeNamed(name);
        if (!found) fail(shown(name) + " where a number type such as float should be");
        return *found;
    }

    /// An array that begins here; steps over it.
    VtkArray array(std::string name, SampleType type, std::uint64_t tuples, std::uint64_t components) {
        if (components == 0 || components > 4096) fail("an array of " + std::to_string(components) + " components");
        VtkArray found{std::move(name), type, source_.position(), tuples, static_cast<int>(components)};
        const std::uint64_t count = checkedMultiply(tuples, components, source_.name());
        if (sections_.text) {
            source_.requireContent(checkedAdd(source_.position(), count == 0 ? 0 : 2 * count - 1, source_.name()));
            skipTokens(count);
            return found;
        }
        const std::uint64_t bytes =
            checkedMultiply(count, bitsOf(type), source_.name()) / 8 + (type == SampleType::kBit && count % 8 != 0 ? 1 : 0);
        const std::uint64_t end = checkedAdd(source_.position(), bytes, source_.name());
        source_.requireContent(end);
        source_.skipTo(end);
        return found;
    }

    void skipTokens(std::uint64_t count) {
        bool inside = false;
        for (char c = 0; count > 0 || inside;) {
            if (!take(c)) {
                if (inside && count == 0) return;
                fail("the file ends, with " + std::to_string(count) + " numbers still to come");
            }
            const bool blank = c == ' ' || c == '\n' || c == '\t' || c == '\r';
            if (!blank && !inside) --count;
            inside = !blank;
        }
    }

    void keepData(VtkArray found) {
        if (!data_) return;
        const auto same = [&](const VtkArray& other) { return other.name == found.name; };
        if (std::none_of(data_->begin(), data_->end(), same)) data_->push_back(std::move(found));
    }

    void lines(const std::vector<std::string>& parts) {
        const std::uint64_t first = whole(parts, 1), second = whole(parts, 2);
        const std::uint64_t before = source_.position();
        const std::vector<std::string> next = words(line());
        if (next.size() == 2 && next[0] == "OFFSETS") {
            sections_.offsets = array("offsets", type(next, 1), first, 1);
            const std::vector<std::string> ids = words(nextLine());
            if (ids.size() != 2 || ids[0] != "CONNECTIVITY") fail("no CONNECTIVITY after OFFSETS");
            sections_.ids = array("ids", type(ids, 1), second, 1);
            sections_.lines = first == 0 ? 0 : first - 1;
            return;
        }
        back(before);
        sections_.cells = array("cells", SampleType::kInt32, second, 1);
        sections_.lines = first;
    }

    void otherCells(const std::vector<std::string>& parts) {
        const std::uint64_t first = whole(parts, 1), second = whole(parts, 2), before = source_.position();
        const std::vector<std::string> next = words(line());
        if (next.size() == 2 && next[0] == "OFFSETS") {
            array("", type(next, 1), first, 1);
            const std::vector<std::string> ids = words(nextLine());
            array("", type(ids, 1), second, 1);
            sections_.other_cells += first == 0 ? 0 : first - 1;
            return;
        }
        back(before);
        array("", SampleType::kInt32, second, 1);
        sections_.other_cells += first;
    }

    void back(std::uint64_t offset) {
        ByteSource again(source_.path());
        again.skipTo(offset);
        source_ = std::move(again);
    }

    std::string nextLine() {
        std::string text;
        for (int i = 0; i < 3 && text.empty(); ++i) text = line();
        return text;
    }

    void field(const std::vector<std::string>& parts) {
        const std::uint64_t arrays = whole(parts, 2);
        for (std::uint64_t i = 0; i < arrays; ++i) {
            const std::vector<std::string> head = words(nextLine());
            if (head.size() == 1 && head[0] == "METADATA") {
                metadata();
                --i;
                continue;
            }
            const std::uint64_t components = whole(head, 1), tuples = whole(head, 2);
            keepData(array(head[0], type(head, 3), tuples, components));
        }
    }

    void metadata() {
        while (!line().empty()) continue;
    }

    /// \return false at the end of the file
    bool keyword() {
        const std::string text = nextLine();
        if (text.empty()) return false;
        const std::vector<std::string> parts = words(text);
        const std::string& key = parts.at(0);
        if (key == "DATASET") {
            if (parts.size() != 2 || parts[1] != "POLYDATA") {
                throw Error(Code::kUnsupported,
                            source_.name() + ": holds " + shown(text) + "; lines are read from POLYDATA only");
            }
        } else if (key == "POINTS") {
            sections_.points = array("points", type(parts, 2), whole(parts, 1), 3);
        } else if (key == "LINES") {
            lines(parts);
        } else if (key == "VERTICES" || key == "POLYGONS" || key == "TRIANGLE_STRIPS") {
            otherCells(parts);
        } else if (key == "METADATA") {
            metadata();
        } else if (key == "POINT_DATA" || key == "CELL_DATA") {
            tuples_ = whole(parts, 1);
            data_ = key == "POINT_DATA" ? &sections_.point_data : &sections_.cell_data;
        } else if (key == "FIELD") {
            field(parts);
        } else {
            return attribute(parts);
        }
        return true;
    }

    bool attribute(const std::vector<std::string>& parts) {
        const std::string& key = parts[0];
        if (key == "SCALARS") {
            if (parts.size() < 3) fail("SCALARS without a name and a type");
            const std::string table = nextLine();
            if (!table.starts_with("LOOKUP_TABLE")) fail("no LOOKUP_TABLE after SCALARS");
            keepData(array(parts.at(1), type(parts, 2), tuples_, parts.size() > 3 ? whole(parts, 3) : 1));
        } else if (key == "VECTORS" || key == "NORMALS") {
            if (parts.size() < 3) fail(key + " without a name and a type");
            keepData(array(parts[1], type(parts, 2), tuples_, 3));
        } else if (key == "TENSORS") {
            if (parts.size() < 3) fail("TENSORS without a name and a type");
            keepData(array(parts[1], type(parts, 2), tuples_, 9));
        } else if (key == "LOOKUP_TABLE") {
            array("", sections_.text ? SampleType::kFloat32 : SampleType::kUInt8, whole(parts, 2), 4);
        } else if (key == "COLOR_SCALARS") {
            array("", sections_.text ? SampleType::kFloat32 : SampleType::kUInt8, tuples_, whole(parts, 2));
        } else {
            sections_.remarks += "What follows " + shown(key) + " is not read. ";
            return false;
        }
        return true;
    }

    ByteSource source_;
    VtkSections sections_;
    std::vector<VtkArray>* data_ = nullptr;
    std::uint64_t tuples_ = 0;
};

}  // namespace

VtkSections readVtkSections(const std::filesystem::path& path) { return Scanner(path).scan(); }

VtkNumbers::VtkNumbers(const std::filesystem::path& path, bool text, const VtkArray& array)
    : source_(path), array_(array), text_(text) {
    source_.skipTo(array.begin);
}

std::string VtkNumbers::token() {
    std::string word;
    for (;;) {
        if (next_ == ahead_.size()) {
            ahead_.resize(1U << 16);
            next_ = 0;
            ahead_.resize(source_.read(std::as_writable_bytes(std::span(ahead_))));
            if (ahead_.empty()) break;
        }
        const char c = ahead_[next_++];
        const bool blank = c == ' ' || c == '\n' || c == '\t' || c == '\r';
        if (!blank && word.size() < 64) word += c;
        if (blank && !word.empty()) break;
    }
    return word;
}

void VtkNumbers::read(std::uint64_t count, std::vector<float>& out) {
    if (text_) {
        for (; count > 0; --count) {
            const std::string word = token();
            double value = 0;
            const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
            if (word.empty() || failure == std::errc::invalid_argument || end != word.data() + word.size()) {
                throw Error(Code::kCorrupt, source_.name() + ": before byte " + std::to_string(source_.position()) + ": " +
                                                shown(word) + " in " + array_.name + ", which is no number");
            }
            out.push_back(static_cast<float>(value));
        }
        return;
    }
    const bool swapped = std::endian::native == std::endian::little;
    while (count > 0) {
        const auto block = static_cast<std::size_t>(std::min<std::uint64_t>(count, kBlockNumbers));
        stored_.resize(block * bitsOf(array_.type) / 8);
        if (source_.read(stored_) < stored_.size()) {
            throw Error(Code::kCorrupt, source_.name() + ": the file ends within " + array_.name);
        }
        const std::size_t before = out.size();
        out.resize(before + block);
        decodeSamples(array_.type, swapped, 1, 0, stored_, std::span(out).subspan(before));
        count -= block;
    }
}

std::int64_t VtkNumbers::readId() {
    const std::size_t bytes = bitsOf(array_.type) / 8;
    std::int64_t value = 0;
    if (text_) {
        const std::string word = token();
        const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (failure != std::errc() || word.empty() || end != word.data() + word.size()) value = -1;
    } else {
        std::array<std::byte, 8> stored{};
        if (bytes > 8 || source_.read(std::span(stored).first(bytes)) < bytes) return -1;
        std::uint64_t joined = 0;
        for (std::size_t i = 0; i < bytes; ++i) joined = joined << 8 | std::to_integer<std::uint64_t>(stored[i]);
        const bool negative = bytes < 8 && (joined >> (8 * bytes - 1)) != 0 && array_.type == SampleType::kInt32;
        value = negative ? -1 : static_cast<std::int64_t>(joined);
    }
    return value;
}

}  // namespace radiata::io
