#include "io/lattice_file.h"

#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include <zlib.h>

#include "base/error.h"

namespace radiata::io {
namespace {

static_assert(std::endian::native == std::endian::little, "files are written as they stand in memory");

/// The first byte is no text, and the line ends show a transfer that changed them.
constexpr std::array<unsigned char, 8> kMagic{0x89, 'L', 'A', 'T', 'T', 'C', '\r', '\n'};
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kKeyMax = 65536, kPayloadMax = 4096;
constexpr std::size_t kTexels = kTexelsPerBrick;
/// A texel's numbers differ from their neighbours' in most bits; more effort than the least finds little more.
constexpr int kEffort = 1;

struct Head {
    std::array<unsigned char, 8> magic;
    std::uint32_t version, payload_bytes;
    std::uint64_t bricks;
    std::uint32_t key_bytes;
    std::uint32_t crc;  ///< of this struct with 0 here, then of the key
};
static_assert(sizeof(Head) == 32);

struct PartHead {
    std::uint32_t bricks, packed_bytes;
    std::uint32_t crc;  ///< of the unpacked bytes
    std::uint32_t reserved;
};
static_assert(sizeof(PartHead) == 16);

std::uint32_t crcOf(std::span<const std::byte> bytes, std::uint32_t before = 0) {
    return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::uint32_t crcOf(Head head, const std::string& key) {
    head.crc = 0;
    return crcOf(std::as_bytes(std::span(key)), crcOf(std::as_bytes(std::span(&head, 1))));
}

std::size_t unpackedBytes(std::size_t bricks, std::uint32_t payload_bytes) {
    return bricks * (4 + kTexels * (4 + std::size_t{payload_bytes}));
}

void append(std::vector<std::byte>& to, std::span<const std::byte> bytes) { to.insert(to.end(), bytes.begin(), bytes.end()); }

template <typename T>
void take(std::span<const std::byte>& from, std::vector<T>& to, std::size_t count) {
    to.resize(count);
    std::memcpy(to.data(), from.data(), count * sizeof(T));
    from = from.subspan(count * sizeof(T));
}

void readAll(ByteSource& file, std::span<std::byte> out, const char* what) {
    const std::uint64_t at = file.position();
    if (file.read(out) == out.size()) return;
    throw Error(Code::kCorrupt, file.name() + ": ends within " + what + " at byte " + std::to_string(at) + ", which takes " +
                                    std::to_string(out.size()) + " bytes");
}

}  // namespace

LatticeWriter::LatticeWriter(const std::filesystem::path& path, const LatticeHeader& header) : header_(header), file_(path) {
    Head head{kMagic, kVersion, header.payload_bytes, header.bricks, static_cast<std::uint32_t>(header.key.size()), 0};
    head.crc = crcOf(head, header.key);
    file_.write(std::as_bytes(std::span(&head, 1)));
    file_.write(header.key);
}

void LatticeWriter::write(const LatticePart& part) {
    std::vector<std::byte> whole;
    append(whole, std::as_bytes(std::span(part.bricks)));
    append(whole, std::as_bytes(std::span(part.states)));
    append(whole, part.payloads);
    if (part.bricks.empty() || part.bricks.size() > LatticePart::kBricksMax ||
        whole.size() != unpackedBytes(part.bricks.size(), header_.payload_bytes)) {
        throw Error(Code::kInternal, "a part of " + std::to_string(part.bricks.size()) + " bricks has " +
                                         std::to_string(whole.size()) + " bytes");
    }
    uLongf packed_bytes = compressBound(static_cast<uLong>(whole.size()));
    std::vector<std::byte> packed(packed_bytes);
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &packed_bytes, reinterpret_cast<const Bytef*>(whole.data()),
                  static_cast<uLong>(whole.size()), kEffort) != Z_OK) {
        throw Error(Code::kInternal, "zlib could not pack a part of a lattice");
    }
    const PartHead head{static_cast<std::uint32_t>(part.bricks.size()), static_cast<std::uint32_t>(packed_bytes), crcOf(whole),
                        0};
    file_.write(std::as_bytes(std::span(&head, 1)));
    file_.write(std::span(packed).first(packed_bytes));
    written_ += part.bricks.size();
}

void LatticeWriter::finish() {
    if (written_ != header_.bricks) {
        throw Error(Code::kInternal,
                    "a lattice of " + std::to_string(header_.bricks) + " bricks was written with " + std::to_string(written_));
    }
    file_.finish();
}

LatticeReader::LatticeReader(const std::filesystem::path& path) : file_(path, Packing::kPlain, 0) {
    Head head{};
    readAll(file_, std::as_writable_bytes(std::span(&head, 1)), "its header");
    if (head.magic != kMagic) throw Error(Code::kCorrupt, file_.name() + ": is no saved illumination lattice");
    if (head.version != kVersion) {
        throw Error(Code::kUnsupported, file_.name() + ": a saved lattice of version " + std::to_string(head.version) +
                                            "; this program knows version " + std::to_string(kVersion));
    }
    if (head.key_bytes > kKeyMax || head.payload_bytes < 4 || head.payload_bytes > kPayloadMax || head.payload_bytes % 4 != 0) {
        throw Error(Code::kCorrupt, file_.name() + ": its header says " + std::to_string(head.payload_bytes) +
                                        " bytes a texel and " + std::to_string(head.key_bytes) + " bytes of description");
    }
    header_.key.resize(head.key_bytes);
    readAll(file_, std::as_writable_bytes(std::span(header_.key)), "its description");
    if (crcOf(head, header_.key) != head.crc) throw Error(Code::kCorrupt, file_.name() + ": the header's checksum is wrong");
    header_.payload_bytes = head.payload_bytes;
    header_.bricks = head.bricks;
}

std::optional<LatticePart> LatticeReader::read(std::uint64_t bricks) {
    if (read_ == header_.bricks) return std::nullopt;
    const std::string where = file_.name() + ": part at byte " + std::to_string(file_.position());
    PartHead head{};
    readAll(file_, std::as_writable_bytes(std::span(&head, 1)), "a part");
    if (head.bricks < 1 || head.bricks > LatticePart::kBricksMax || head.bricks > header_.bricks - read_) {
        throw Error(Code::kCorrupt, where + " says it has " + std::to_string(head.bricks) + " bricks; " +
                                        std::to_string(header_.bricks - read_) + " are left, and a part has 1 to 64");
    }
    const std::size_t bytes = unpackedBytes(head.bricks, header_.payload_bytes);
    if (head.packed_bytes > compressBound(static_cast<uLong>(bytes))) {
        throw Error(Code::kCorrupt,
                    where + " says it has " + std::to_string(head.packed_bytes) + " packed bytes for " + std::to_string(bytes));
    }
    std::vector<std::byte> packed(head.packed_bytes), whole(bytes);
    readAll(file_, packed, "a part");
    uLongf found = static_cast<uLongf>(bytes);
    const int state = uncompress(reinterpret_cast<Bytef*>(whole.data()), &found, reinterpret_cast<const Bytef*>(packed.data()),
                                 static_cast<uLong>(packed.size()));
    if (state != Z_OK || found != bytes) throw Error(Code::kCorrupt, where + " cannot be unpacked");
    if (crcOf(whole) != head.crc) throw Error(Code::kCorrupt, where + " has a wrong checksum");
    LatticePart part;
    std::span<const std::byte> rest(whole);
    take(rest, part.bricks, head.bricks);
    take(rest, part.states, head.bricks * kTexels);
    take(rest, part.payloads, rest.size());
    for (const std::uint32_t brick : part.bricks) {
        if (brick < bricks) continue;
        throw Error(Code::kCorrupt, where + " names brick " + std::to_string(brick) + " of " + std::to_string(bricks));
    }
    read_ += head.bricks;
    return part;
}

SavedLattice readLattice(const std::filesystem::path& path, const LatticeHeader& wanted) {
    LatticeReader reader(path);
    SavedLattice saved{path.filename().string(), reader.header(), {}};
    if (!(saved.header == wanted)) {
        throw Error(Code::kInvalidArgument, saved.name + ": is a saved lattice of something else (" + saved.header.key + ")");
    }
    std::vector<bool> seen(wanted.bricks);
    while (std::optional<LatticePart> part = reader.read(wanted.bricks)) {
        for (const std::uint32_t brick : part->bricks) {
            if (seen[brick]) throw Error(Code::kCorrupt, saved.name + ": has brick " + std::to_string(brick) + " twice");
            seen[brick] = true;
        }
        saved.parts.push_back(std::move(*part));
    }
    return saved;
}

}  // namespace radiata::io
