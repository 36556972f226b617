#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "base/checked.h"
#include "base/error.h"
#include "base/parallel.h"
#include "io/byte_source.h"
#include "io/fiblet_check.h"
#include "io/fiblet_file.h"
#include "io/fiblet_layout.h"
#include "io/fiblet_page_file.h"

namespace radiata::io {
namespace {

using namespace fiblet;

std::string hex(std::uint32_t value) {
    char text[16];
    std::snprintf(text, sizeof text, "0x%08x", value);
    return text;
}

/// A section's bytes, taken from the front.
class Bytes {
public:
    Bytes(std::span<const std::byte> bytes, std::string where) : bytes_(bytes), where_(std::move(where)) {}

    template <typename T>
    std::vector<T> take(std::uint64_t count, const char* what) {
        const std::uint64_t size = checkedMultiply(count, sizeof(T), where_);
        if (size > bytes_.size()) {
            throw Error(Code::kCorrupt, where_ + " has " + std::to_string(bytes_.size()) + " bytes left for " + what +
                                            ", which takes " + std::to_string(size));
        }
        std::vector<T> values(count);
        if (count > 0) std::memcpy(static_cast<void*>(values.data()), bytes_.data(), size);
        bytes_ = bytes_.subspan(size);
        return values;
    }

    std::pair<std::string, std::uint32_t> takeName() {
        const Name name = take<Name>(1, "a name's length")[0];
        if (name.bytes > kNameMax)
            throw Error(Code::kCorrupt, where_ + " has a name of " + std::to_string(name.bytes) + " bytes");
        const std::vector<char> text = take<char>(aligned(name.bytes, 8), "a name");
        return {std::string(text.data(), name.bytes), name.number};
    }

    void skipToMultipleOf8(std::uint64_t taken) { take<std::byte>(aligned(taken, 8) - taken, "filling"); }

    void requireEnd() const {
        if (!bytes_.empty()) throw Error(Code::kCorrupt, where_ + " has " + std::to_string(bytes_.size()) + " bytes too many");
    }

private:
    std::span<const std::byte> bytes_;
    std::string where_;
};

class Reader {
public:
    explicit Reader(const std::filesystem::path& path) : source_(path, Packing::kPlain, 0), name_(source_.name()) {
        read(std::as_writable_bytes(std::span(&header_, 1)));
        if (header_.magic != kMagic) fail("does not begin as a .fiblet file does");
        if (header_.version != kVersion) {
            throw Error(Code::kUnsupported, name_ + ": is of version " + std::to_string(header_.version) +
                                                "; this program reads version " + std::to_string(kVersion));
        }
        if (header_.file_bytes != source_.fileBytes()) {
            fail("has " + std::to_string(source_.fileBytes()) + " bytes, but was written with " +
                 std::to_string(header_.file_bytes) + "; it is cut off or damaged");
        }
        if (header_.sections > kSectionsMax) fail("says that it has " + std::to_string(header_.sections) + " sections");
        source_.requireContent(sizeof(Header) + header_.sections * sizeof(Section));
        sections_.resize(header_.sections);
        read(std::as_writable_bytes(std::span(sections_)));
        Header plain = header_;
        plain.crc = 0;
        const std::uint32_t crc = crcOf(std::as_bytes(std::span(sections_)), crcOf(std::as_bytes(std::span(&plain, 1))));
        if (crc != header_.crc) fail("the header's checksum is " + hex(crc) + " instead of " + hex(header_.crc));
        checkSections();
    }

    model::FibletSet head() const {
        model::FibletSet set;
        set.source = name_;
        set.codec = header_.codec;
        set.origin_mm = {header_.origin_mm[0], header_.origin_mm[1], header_.origin_mm[2]};
        set.points = header_.points;
        set.bound_um = header_.bound_um;
        set.errors = {header_.mean_um, header_.max_um, header_.measured_points};
        set.walked = header_.walked != 0;
        set.walk_errors = {header_.walk_mean_um, header_.walk_max_um, header_.walk_points};
        return set;
    }

    model::FibletSet all() {
        model::FibletSet set = head();
        std::vector<std::uint32_t> checks;
        for (const Section& section : sections_) {
            std::vector<std::byte> content(section.bytes);
            source_.skipTo(section.offset);
            read(content);
            const std::string where = name_ + ": section of kind " + std::to_string(section.kind);
            if (section.kind != kHeads && section.kind != kCodes && crcOf(content) != section.crc) {
                fail("the checksum of the section of kind " + std::to_string(section.kind) + " is " + hex(crcOf(content)) +
                     " instead of " + hex(section.crc));
            }
            Bytes bytes(content, where);
            take(section, bytes, set, checks);
            bytes.requireEnd();
        }
        const std::uint64_t words = set.codes.size();
        set.codes.push_back(0);
        checkPages(set, words, checks);
        checkFiblets(set, words, name_);
        set.file = pageFile(set.pages, std::move(checks), words);
        return set;
    }

private:
    const Section& sectionOf(std::uint32_t kind) const { return *std::ranges::find(sections_, kind, &Section::kind); }

    std::shared_ptr<const model::FibletPageSource> pageFile(const std::vector<shader::FibletPage>& pages,
                                                            std::vector<std::uint32_t> checks, std::uint64_t words) const {
        return std::make_shared<const FibletPageFile>(source_.path(), pages, std::move(checks), sectionOf(kHeads).offset,
                                                      sectionOf(kCodes).offset, words);
    }

    [[noreturn]] void fail(const std::string& what) const { throw Error(Code::kCorrupt, name_ + ": " + what); }

    void read(std::span<std::byte> out) {
        const std::size_t got = source_.read(out);
        if (got < out.size()) fail("ends too early: " + std::to_string(out.size() - got) + " bytes are missing");
    }

    void checkSections() const {
        std::uint64_t end = sizeof(Header) + sections_.size() * sizeof(Section);
        for (const Section& section : sections_) {
            if (section.offset % kAlignment != 0 || section.offset < end ||
                checkedAdd(section.offset, section.bytes, name_) > header_.file_bytes) {
                fail("a section of kind " + std::to_string(section.kind) + " has " + std::to_string(section.bytes) +
                     " bytes from " + std::to_string(section.offset) + " on, which overlaps others or ends behind the file");
            }
            end = section.offset + section.bytes;
        }
        for (const std::uint32_t kind : {kHeads, kCodes, kPages, kPageChecks, kFibreFirst, kFibreFiblets}) {
            const auto count =
                std::count_if(sections_.begin(), sections_.end(), [&](const Section& s) { return s.kind == kind; });
            if (count != 1)
                fail("has " + std::to_string(count) + " sections of kind " + std::to_string(kind) + "; it needs one");
        }
        if (header_.fibres > model::kFibreCountMax || header_.fiblets > 0xffffffffULL) {
            fail("says that it has " + std::to_string(header_.fibres) + " fibres and " + std::to_string(header_.fiblets) +
                 " fiblets");
        }
    }

    void take(const Section& section, Bytes& bytes, model::FibletSet& set, std::vector<std::uint32_t>& checks) const {
        const std::uint64_t fiblets = header_.fiblets, fibres = header_.fibres;
        switch (section.kind) {
            case kHeads:
                set.heads = bytes.take<model::FibletHead>(fiblets, "heads");
                break;
            case kCodes:
                set.codes = bytes.take<std::uint32_t>(section.bytes / 4, "codes");
                break;
            case kPages:
                set.pages = bytes.take<shader::FibletPage>(section.bytes / sizeof(shader::FibletPage), "pages");
                break;
            case kPageChecks:
                checks = bytes.take<std::uint32_t>(section.bytes / 4, "checksums");
                break;
            case kFibreFirst:
                set.fibre_first = bytes.take<std::uint32_t>(fibres + 1, "the fibres' first fiblets");
                break;
            case kFibreFiblets:
                set.fibre_fiblets = bytes.take<std::uint32_t>(fiblets, "the fibres' fiblets");
                break;
            case kFibreColumn: {
                auto [name, components] = bytes.takeName();
                checkComponents(name, components);
                const std::uint64_t count = checkedMultiply(fibres, components, name_);
                set.fibre_columns.push_back({std::move(name), components, bytes.take<float>(count, "a fibre column")});
                break;
            }
            case kPointColumn: {
                auto [name, component] = bytes.takeName();
                std::vector<glm::vec2> ranges = bytes.take<glm::vec2>(fiblets, "a point column's ranges");
                set.point_columns.push_back(
                    {std::move(name), component, std::move(ranges), bytes.take<std::uint8_t>(64 * fiblets, "a point column")});
                break;
            }
            case kGroup:
                set.groups.push_back(takeGroup(bytes));
                break;
            case kRemarks: {
                if (section.bytes > kRemarksMax)
                    fail("has remarks of " + std::to_string(section.bytes) + " bytes; at most " + std::to_string(kRemarksMax) +
                         " are read");
                const std::vector<char> text = bytes.take<char>(section.bytes, "remarks");
                set.remarks.assign(text.begin(), text.end());
                break;
            }
            default:
                throw Error(Code::kUnsupported, name_ + ": has a section of kind " + std::to_string(section.kind) +
                                                    ", which this program does not know");
        }
    }

    void checkComponents(const std::string& column, std::uint32_t components) const {
        if (components == 0 || components > kComponentsMax) {
            fail("column '" + column + "' says that it has " + std::to_string(components) +
                 " components; it would have to be 1 to " + std::to_string(kComponentsMax));
        }
    }

    model::FibreGroup takeGroup(Bytes& bytes) const {
        model::FibreGroup group;
        auto [name, columns] = bytes.takeName();
        group.name = std::move(name);
        const std::uint64_t count = bytes.take<std::uint64_t>(1, "a group's size")[0];
        group.fibres = bytes.take<std::uint32_t>(count, "a group's fibres");
        bytes.skipToMultipleOf8(4 * count);
        for (std::size_t i = 0; i < group.fibres.size(); ++i) {
            if (group.fibres[i] >= header_.fibres || (i > 0 && group.fibres[i] <= group.fibres[i - 1])) {
                fail("group '" + group.name + "' lists fibre " + std::to_string(group.fibres[i]) + " of " +
                     std::to_string(header_.fibres) + " twice, out of order or past the end");
            }
        }
        for (std::uint32_t c = 0; c < columns; ++c) {
            auto [column, components] = bytes.takeName();
            checkComponents(column, components);
            group.values.push_back(bytes.take<float>(components, "a group's values"));
            bytes.skipToMultipleOf8(4 * std::uint64_t(components));
            group.columns.push_back({std::move(column), int(components)});
        }
        return group;
    }

    void checkPages(const model::FibletSet& set, std::uint64_t words, const std::vector<std::uint32_t>& checks) const {
        if (checks.size() != set.pages.size())
            fail("has " + std::to_string(checks.size()) + " checksums for " + std::to_string(set.pages.size()) + " pages");
        parallelFor(set.pages.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t p = begin; p < end; ++p) {
                const std::uint64_t first = p * shader::FIBLET_PAGE,
                                    stop = p + 1 < set.pages.size() ? set.pages[p + 1].first_word : words;
                if (first + set.pages[p].count > set.heads.size() || set.pages[p].first_word > stop || stop > words) {
                    fail("page " + std::to_string(p) + " lies outside of the heads or codes");
                }
                const auto heads = std::span(set.heads).subspan(first, set.pages[p].count);
                const auto own = std::span(set.codes).subspan(set.pages[p].first_word, stop - set.pages[p].first_word);
                const std::uint32_t crc = crcOf(std::as_bytes(own), crcOf(std::as_bytes(heads)));
                if (crc != checks[p])
                    fail("the checksum of page " + std::to_string(p) + " is " + hex(crc) + " instead of " + hex(checks[p]));
            }
        });
    }

    ByteSource source_;
    std::string name_;
    Header header_{};
    std::vector<Section> sections_;
};

}  // namespace

bool isFibletName(const std::filesystem::path& path) { return path.extension() == ".fiblet"; }

model::FibletSet readFiblets(const std::filesystem::path& path) { return Reader(path).all(); }

model::FibletSet readFibletHeader(const std::filesystem::path& path) { return Reader(path).head(); }

}  // namespace radiata::io
