#include "io/fiblet_writer.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "io/fiblet_file.h"

namespace radiata::io {
namespace {

using namespace fiblet;

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

std::vector<std::byte> groupContent(const model::FibreGroup& group) {
    std::vector<std::byte> content;
    appendName(content, group.name, std::uint32_t(group.columns.size()));
    const std::uint64_t count = group.fibres.size();
    append(content, std::as_bytes(std::span(&count, 1)));
    append(content, bytesOf(group.fibres));
    content.resize(aligned(content.size(), 8));
    for (std::size_t c = 0; c < group.columns.size(); ++c) {
        appendName(content, group.columns[c].name, std::uint32_t(group.columns[c].components));
        append(content, bytesOf(group.values[c]));
        content.resize(aligned(content.size(), 8));
    }
    return content;
}

std::vector<std::uint32_t> pageChecks(const model::FibletSet& set) {
    const auto codes = std::span(set.codes).first(set.codes.size() - 1);
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

Header headerOf(const model::FibletSet& set, const FibletCounts& counts) {
    Header header{};
    header.magic = kMagic;
    header.version = kVersion;
    header.fibres = counts.fibres;
    header.fiblets = counts.fiblets;
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

FibletWriter::FibletWriter(const std::filesystem::path& path, const model::FibletSet& set, const FibletCounts& counts)
    : file_(path), header_(headerOf(set, counts)), columns_(set.point_columns.size()) {
    add(kHeads, {}, counts.fiblets * sizeof(model::FibletHead));
    add(kCodes, {}, 4 * counts.words);
    const std::uint64_t pages = (counts.fiblets + shader::FIBLET_PAGE - 1) / shader::FIBLET_PAGE;
    add(kPages, {}, pages * sizeof(shader::FibletPage));
    add(kPageChecks, {}, 4 * pages);
    add(kFibreFirst, {}, 4 * (counts.fibres + 1));
    add(kFibreFiblets, {}, 4 * counts.fiblets);
    fibre_columns_ = parts_.size();
    for (const model::FibreColumn& column : set.fibre_columns) {
        std::vector<std::byte> name;
        appendName(name, column.name, column.components);
        add(kFibreColumn, name, 4 * column.components * counts.fibres);
    }
    point_columns_ = parts_.size();
    for (const model::PointColumn& column : set.point_columns) {
        std::vector<std::byte> name;
        appendName(name, column.name, column.component);
        add(kPointColumn, name, counts.fiblets * sizeof(glm::vec2), 64 * counts.fiblets);
    }
    for (const model::FibreGroup& group : set.groups) add(kGroup, groupContent(group), 0);
    if (!set.remarks.empty()) {
        const auto text = std::as_bytes(std::span(set.remarks));
        add(kRemarks, {text.begin(), text.begin() + std::ptrdiff_t(std::min<std::size_t>(text.size(), kRemarksMax))}, 0);
    }
    place();
}

void FibletWriter::add(std::uint32_t kind, std::vector<std::byte> own, std::uint64_t first, std::uint64_t second) {
    sections_.push_back({kind, 0, 0, own.size() + first + second});
    parts_.push_back({std::move(own), {0, first}, {0, second}});
}

/// Finds where everything goes, and writes what is known already, the gaps' zeros among it.
void FibletWriter::place() {
    header_.sections = std::uint32_t(sections_.size());
    std::uint64_t end = sizeof(Header) + sections_.size() * sizeof(Section);
    const std::vector<std::byte> zeros(kAlignment);
    for (std::size_t i = 0; i < sections_.size(); ++i) {
        sections_[i].offset = aligned(end, kAlignment);
        file_.seek(end);
        file_.write(std::span(zeros).first(sections_[i].offset - end));
        Part& part = parts_[i];
        file_.write(part.own);
        part.first.at = sections_[i].offset + part.own.size();
        part.second.at = part.first.at + part.first.left;
        end = sections_[i].offset + sections_[i].bytes;
    }
    header_.file_bytes = end;
}

void FibletWriter::put(Stream& stream, std::span<const std::byte> bytes) {
    if (bytes.size() > stream.left) {
        throw Error(Code::kInternal, file_.path().string() + ": more content than was counted by " +
                                         std::to_string(bytes.size() - stream.left) + " bytes");
    }
    file_.seek(stream.at);
    file_.write(bytes);
    stream.crc = crcOf(bytes, stream.crc);
    stream.at += bytes.size();
    stream.left -= bytes.size();
    stream.bytes += bytes.size();
}

void FibletWriter::addPages(const model::FibletSet& set) {
    put(parts_[0].first, bytesOf(set.heads));
    put(parts_[1].first, bytesOf(set.codes).first(4 * (set.codes.size() - 1)));
    std::vector<shader::FibletPage> pages = set.pages;
    for (shader::FibletPage& page : pages) page.first_word += std::uint32_t(words_);
    words_ += set.codes.size() - 1;
    put(parts_[2].first, bytesOf(pages));
    put(parts_[3].first, bytesOf(pageChecks(set)));
    for (std::size_t c = 0; c < columns_; ++c) {
        put(parts_[point_columns_ + c].first, bytesOf(set.point_columns[c].ranges));
        put(parts_[point_columns_ + c].second, bytesOf(set.point_columns[c].values));
    }
}

void FibletWriter::addFibreFirst(std::span<const std::uint32_t> numbers) { put(parts_[4].first, std::as_bytes(numbers)); }

void FibletWriter::addFibreFiblets(std::span<const std::uint32_t> heads) { put(parts_[5].first, std::as_bytes(heads)); }

void FibletWriter::addFibreColumn(std::size_t column, std::span<const float> values) {
    put(parts_[fibre_columns_ + column].first, std::as_bytes(values));
}

void FibletWriter::finish() {
    for (std::size_t i = 0; i < sections_.size(); ++i) {
        const Part& part = parts_[i];
        if (part.first.left > 0 || part.second.left > 0) {
            throw Error(Code::kInternal, file_.path().string() + ": the section of kind " + std::to_string(sections_[i].kind) +
                                             " misses " + std::to_string(part.first.left + part.second.left) + " bytes");
        }
        if (sections_[i].kind == kHeads || sections_[i].kind == kCodes) continue;
        const auto joined = [](std::uint32_t crc, const Stream& stream) {
            return std::uint32_t(crc32_combine(crc, stream.crc, std::int64_t(stream.bytes)));
        };
        sections_[i].crc = joined(joined(crcOf(part.own), part.first), part.second);
    }
    header_.crc = crcOf(bytesOf(sections_), crcOf(std::as_bytes(std::span(&header_, 1))));
    file_.seek(0);
    file_.write(std::as_bytes(std::span(&header_, 1)));
    file_.writeNumbers(std::span<const Section>(sections_));
    file_.finish();
}

void writeFiblets(const model::FibletSet& set, const std::filesystem::path& path) {
    FibletWriter writer(path, set, {set.fibres(), set.heads.size(), set.codes.size() - 1});
    writer.addPages(set);
    writer.addFibreFirst(set.fibre_first);
    writer.addFibreFiblets(set.fibre_fiblets);
    for (std::size_t c = 0; c < set.fibre_columns.size(); ++c) writer.addFibreColumn(c, set.fibre_columns[c].values);
    writer.finish();
}

}  // namespace radiata::io
