// Any bytes given to the readers of .fiblet, .fiblet76 and .qfib files: they either read them or throw Error, and what they
// read can be decoded. The first byte chooses: 0 a .qfib file; 1 a .fiblet file as it is; 3 a .fiblet76 file and else a .fiblet
// file whose sizes and checksums are put right first, so that what lies behind them is met, too.
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "build/fiblet_pages.h"
#include "build/fiblet_paper.h"
#include "build/fiblet_source.h"
#include "ingest/fiblet76_file.h"
#include "io/fiblet_file.h"
#include "io/fiblet_layout.h"
#include "io/qfib.h"

namespace {

using namespace radiata;
using namespace radiata::io::fiblet;

std::filesystem::path inputPath() {
    return std::filesystem::temp_directory_path() / ("radiata_fuzz_" + std::to_string(::getpid()) + ".bin");
}

std::span<const std::byte> part(const std::string& bytes, std::uint64_t offset, std::uint64_t size) {
    if (offset > bytes.size() || size > bytes.size() - offset) return {};
    return std::as_bytes(std::span(bytes)).subspan(offset, size);
}

/// Checksums of the pages, if there are heads, codes and pages to make them of.
void repairPages(std::string& bytes, const std::vector<Section>& sections) {
    const Section* of[8] = {};
    for (const Section& section : sections) {
        if (section.kind < 8 && !part(bytes, section.offset, section.bytes).empty()) of[section.kind] = &section;
    }
    if (!of[kHeads] || !of[kCodes] || !of[kPages] || !of[kPageChecks]) return;
    const std::size_t count = std::min(of[kPages]->bytes / sizeof(shader::FibletPage), of[kPageChecks]->bytes / 4);
    std::vector<shader::FibletPage> pages(count);
    for (std::size_t p = 0; p < count; ++p) {
        std::memcpy(static_cast<void*>(&pages[p]), bytes.data() + of[kPages]->offset + p * sizeof(shader::FibletPage),
                    sizeof(shader::FibletPage));
    }
    for (std::size_t p = 0; p < count; ++p) {
        const std::uint64_t first = p * shader::FIBLET_PAGE * sizeof(model::FibletHead),
                            heads = pages[p].count * sizeof(model::FibletHead);
        const std::uint64_t words = 4 * (pageWords(pages, p, of[kCodes]->bytes / 4) & 0xffffffffU);
        const auto a = part(bytes, of[kHeads]->offset + first, heads),
                   b = part(bytes, of[kCodes]->offset + 4ULL * pages[p].first_word, words);
        const std::uint32_t crc = crcOf(b, crcOf(a));
        std::memcpy(bytes.data() + of[kPageChecks]->offset + 4 * p, &crc, 4);
    }
}

void repair(std::string& bytes) {
    Header header;
    if (bytes.size() < sizeof header) return;
    std::memcpy(&header, bytes.data(), sizeof header);
    header.magic = kMagic;
    header.version = kVersion;
    header.file_bytes = bytes.size();
    header.crc = 0;
    header.sections = std::min<std::uint32_t>(header.sections, std::uint32_t((bytes.size() - sizeof header) / sizeof(Section)));
    std::vector<Section> sections(header.sections);
    const auto table = std::as_writable_bytes(std::span(sections));
    const auto stored = std::as_bytes(std::span(bytes)).subspan(sizeof header, table.size());
    std::ranges::copy(stored, table.begin());
    repairPages(bytes, sections);
    for (Section& section : sections) {
        if (section.kind != kHeads && section.kind != kCodes) section.crc = crcOf(part(bytes, section.offset, section.bytes));
    }
    header.crc = crcOf(std::as_bytes(std::span(sections)), crcOf(std::as_bytes(std::span(&header, 1))));
    std::ranges::copy(table, std::as_writable_bytes(std::span(bytes)).begin() + sizeof header);
    std::memcpy(bytes.data(), &header, sizeof header);
}

/// The same of a .fiblet76 file: as many records as there is room for.
void repair76(std::string& bytes) {
    ingest::Fiblet76Header header;
    if (bytes.size() < sizeof header) return;
    std::memcpy(static_cast<void*>(&header), bytes.data(), sizeof header);
    header.magic = ingest::kFiblet76Magic;
    header.version = 1;
    header.record_bytes = kPaperBytes;
    header.fiblets = std::min<std::uint64_t>((bytes.size() - sizeof header) / kPaperBytes, ingest::kFiblet76Block);
    bytes.resize(sizeof header + kPaperBytes * header.fiblets + (header.fiblets > 0 ? 4 : 0));
    header.file_bytes = bytes.size();
    header.crc = 0;
    header.crc = crcOf(std::as_bytes(std::span(&header, 1)));
    std::memcpy(bytes.data(), &header, sizeof header);
    if (header.fiblets == 0) return;
    const std::uint32_t crc = crcOf(part(bytes, sizeof header, kPaperBytes * header.fiblets));
    std::memcpy(bytes.data() + bytes.size() - 4, &crc, 4);
}

void readAndDecode(const std::filesystem::path& path, std::uint8_t choice) {
    if (choice == 0 || choice == 3) {
        model::readAll(*(choice == 0 ? io::openQfib(path) : ingest::openFiblet76(path)), 1U << 28);
        return;
    }
    model::FibletSet set = io::readFiblets(path);
    boundFiblets(set);
    model::readAll(*sourceOf(set), 1U << 28);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    if (data[0] == 3) {
        repair76(bytes);
    } else if (data[0] > 1) {
        repair(bytes);
    }
    const std::filesystem::path path = inputPath();
    std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
    try {
        readAndDecode(path, data[0]);
    } catch (const Error&) {
    }
    std::filesystem::remove(path);
    return 0;
}
