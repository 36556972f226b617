#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "io/fiblet_file.h"
#include "io/fiblet_layout.h"
#include "io/write_file.h"

namespace radiata::io {
namespace {

using namespace fiblet;

/// Bytes of a section: some of its own, then those of arrays that stay where they are.
struct Content {
    std::uint32_t kind = 0;
    std::vector<std::byte> own;
    std::vector<std::span<const std::byte>> arrays;

    std::uint64_t bytes() const {
        std::uint64_t sum = own.size();
        for (const auto& array : arrays) sum += array.size();
        return sum;
    }
};

template <typename T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

void append(std::vector<std::byte>& to, std::span<const std::byte> bytes) { to.insert(to.end(), bytes.begin(), bytes.end()); }

void appendName(std::vector<std::byte>& to, const std::string& name, std::uint32_t number) {
    if (name.size() > kNameMax) {
        throw Error(Code::kInvalidArgument, "the name of a column or group has " + std::to_string(name.size()) +
                                                " bytes; a .fiblet file holds at most " + std::to_string(kNameMax));
    }
    const Name head{std::uint32_t(name.size()), number};
    append(to, std::as_bytes(std::span(&head, 1)));
    append(to, std::as_bytes(std::span(name)));
    to.resize(aligned(to.size(), 8));
}

std::vector<std::uint32_t> pageChecks(const model::FibletSet& set, std::span<const std::uint32_t> codes) {
    std::vector<std::uint32_t> checks(set.pages.size());
    parallelFor(set.pages.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            const auto heads = std::span(set.heads).subspan(p * shader::FIBLET_PAGE, set.pages[p].count);
            const auto words = codes.subspan(set.pages[p].first_word, pageWords(set.pages, p, codes.size()));
            checks[p] = crcOf(std::as_bytes(words), crcOf(std::as_bytes(heads)));
        }
    });
    return checks;
}

Content groupContent(const model::FibreGroup& group) {
    Content content{kGroup, {}, {}};
    appendName(content.own, group.name, std::uint32_t(group.columns.size()));
    const std::uint64_t count = group.fibres.size();
    append(content.own, std::as_bytes(std::span(&count, 1)));
    append(content.own, bytesOf(group.fibres));
    content.own.resize(aligned(content.own.size(), 8));
    for (std::size_t c = 0; c < group.columns.size(); ++c) {
        appendName(content.own, group.columns[c].name, std::uint32_t(group.columns[c].components));
        append(content.own, bytesOf(group.values[c]));
        content.own.resize(aligned(content.own.size(), 8));
    }
    return content;
}

std::vector<Content> contentsOf(const model::FibletSet& set, const std::vector<std::uint32_t>& checks) {
    std::vector<Content> all;
    all.push_back({kHeads, {}, {bytesOf(set.heads)}});
    all.push_back({kCodes, {}, {bytesOf(set.codes).first(4 * (set.codes.size() - 1))}});
    all.push_back({kPages, {}, {bytesOf(set.pages)}});
    all.push_back({kPageChecks, {}, {bytesOf(checks)}});
    all.push_back({kFibreFirst, {}, {bytesOf(set.fibre_first)}});
    all.push_back({kFibreFiblets, {}, {bytesOf(set.fibre_fiblets)}});
    for (const model::FibreColumn& column : set.fibre_columns) {
        Content content{kFibreColumn, {}, {bytesOf(column.values)}};
        appendName(content.own, column.name, column.components);
        all.push_back(std::move(content));
    }
    for (const model::PointColumn& column : set.point_columns) {
        Content content{kPointColumn, {}, {bytesOf(column.ranges), bytesOf(column.values)}};
        appendName(content.own, column.name, column.component);
        all.push_back(std::move(content));
    }
    for (const model::FibreGroup& group : set.groups) all.push_back(groupContent(group));
    return all;
}

Header headerOf(const model::FibletSet& set) {
    Header header{};
    header.magic = kMagic;
    header.version = kVersion;
    header.fibres = set.fibres();
    header.fiblets = set.heads.size();
    header.points = set.points;
    header.origin_mm = {set.origin_mm.x, set.origin_mm.y, set.origin_mm.z};
    header.codec = set.codec;
    header.bound_um = set.bound_um;
    header.mean_um = set.errors.mean_um;
    header.max_um = set.errors.max_um;
    header.measured_points = set.errors.points;
    header.walked = set.walked ? 1 : 0;
    header.walk_mean_um = set.walk_errors.mean_um;
    header.walk_max_um = set.walk_errors.max_um;
    header.walk_points = set.walk_errors.points;
    return header;
}

}  // namespace

void writeFiblets(const model::FibletSet& set, const std::filesystem::path& path) {
    const std::vector<std::uint32_t> checks = pageChecks(set, std::span(set.codes).first(set.codes.size() - 1));
    const std::vector<Content> contents = contentsOf(set, checks);
    Header header = headerOf(set);
    header.sections = std::uint32_t(contents.size());
    std::vector<Section> sections;
    std::uint64_t end = sizeof(Header) + contents.size() * sizeof(Section);
    for (const Content& content : contents) {
        Section section{content.kind, 0, aligned(end, kAlignment), content.bytes()};
        if (content.kind != kHeads && content.kind != kCodes) {
            section.crc = crcOf(content.own);
            for (const auto& array : content.arrays) section.crc = crcOf(array, section.crc);
        }
        end = section.offset + section.bytes;
        sections.push_back(section);
    }
    header.file_bytes = end;
    header.crc = crcOf(bytesOf(sections), crcOf(std::as_bytes(std::span(&header, 1))));

    WriteFile file(path);
    file.write(std::as_bytes(std::span(&header, 1)));
    file.writeNumbers(std::span<const Section>(sections));
    std::uint64_t at = sizeof(Header) + sections.size() * sizeof(Section);
    const std::vector<std::byte> zeros(kAlignment);
    for (std::size_t i = 0; i < sections.size(); ++i) {
        file.write(std::span(zeros).first(sections[i].offset - at));
        file.write(contents[i].own);
        for (const auto& array : contents[i].arrays) file.write(array);
        at = sections[i].offset + sections[i].bytes;
    }
    file.finish();
}

}  // namespace radiata::io
