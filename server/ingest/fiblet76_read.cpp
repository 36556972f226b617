// Reads files of the paper's 76-byte records, checking each block before any of it is decoded.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "build/fiblet_paper.h"
#include "ingest/fiblet76_file.h"
#include "io/byte_source.h"
#include "io/fiblet_layout.h"
#include "io/fibre_builder.h"

namespace radiata::ingest {
namespace {

using io::fiblet::crcOf;

constexpr std::size_t kFibreByte = 70, kIndexByte = 74, kFlagsByte = 75;

class Fiblet76Source : public model::TractogramSource {
public:
    explicit Fiblet76Source(const std::filesystem::path& path) : source_(path, io::Packing::kPlain, 0), builder_(header_) {
        header_.source = source_.name();
        header_.format = "fiblet76";
        take(std::as_writable_bytes(std::span(&file_, 1)), "the header");
        if (file_.magic != kFiblet76Magic) fail("does not begin as a .fiblet76 file does");
        if (file_.version != 1 || file_.record_bytes != kPaperBytes) {
            throw Error(Code::kUnsupported, header_.source + ": is of version " + std::to_string(file_.version) +
                                                " with records of " + std::to_string(file_.record_bytes) +
                                                " bytes; version 1 with 76 bytes is read");
        }
        Fiblet76Header plain = file_;
        plain.crc = 0;
        if (crcOf(std::as_bytes(std::span(&plain, 1))) != file_.crc)
            fail("the header's checksum is wrong; the file was changed");
        checkSizes();
        codec_ = {{file_.origin_mm[0], file_.origin_mm[1], file_.origin_mm[2]}, file_.extent_mm, file_.step_mm, file_.ratio};
        checkCodec();
        header_.fibre_count = file_.fibres;
        header_.point_count = file_.points;
    }

    const model::TractogramHeader& header() const override { return header_; }

    bool read(model::FibreBatch& batch, std::size_t points_wanted) override {
        builder_.begin(batch);
        while (builder_.fibres() < file_.fibres && (batch.fibreCount() == 0 || batch.points.size() < points_wanted) &&
               batch.fibreCount() < kBatchFibres) {
            readFibre();
        }
        if (batch.fibreCount() == 0) checkEnd();
        return batch.fibreCount() > 0;
    }

    std::uint64_t damagedFibres() const override { return builder_.damagedFibres(); }
    std::uint64_t bytesRead() const override { return source_.fileBytesRead(); }
    std::uint64_t bytesTotal() const override { return source_.fileBytes(); }

private:
    static constexpr std::size_t kBatchFibres = 1 << 16;

    [[noreturn]] void fail(const std::string& what) const { throw Error(Code::kCorrupt, header_.source + ": " + what); }

    void take(std::span<std::byte> bytes, const char* what) {
        const std::size_t got = source_.read(bytes);
        if (got < bytes.size())
            fail("ends in " + std::string(what) + ", " + std::to_string(bytes.size() - got) + " bytes too early");
    }

    void checkSizes() const {
        const std::uint64_t most = source_.fileBytes() / kPaperBytes;
        const std::uint64_t blocks = (std::min(file_.fiblets, most + 1) + kFiblet76Block - 1) / kFiblet76Block;
        const bool fits = file_.fiblets <= most && sizeof file_ + kPaperBytes * file_.fiblets + 4 * blocks == file_.file_bytes;
        if (file_.file_bytes != source_.fileBytes() || !fits) {
            fail("has " + std::to_string(source_.fileBytes()) + " bytes, but was written with " +
                 std::to_string(file_.file_bytes) + " for " + std::to_string(file_.fiblets) +
                 " fiblets; it is cut off or damaged");
        }
        if (file_.fibres > model::kFibreCountMax || file_.fibres > fiblet76FibresMax(file_.fiblets) ||
            file_.points > kPaperPoints * file_.fiblets) {
            fail("says that it has " + std::to_string(file_.fibres) + " fibres and " + std::to_string(file_.points) +
                 " points in " + std::to_string(file_.fiblets) + " fiblets");
        }
    }

    void checkCodec() const {
        const double most = model::kCoordinateMaxMm;
        const auto require = [&](bool right, const char* what, double value) {
            if (!right) fail(std::string("has ") + what + " " + std::to_string(value) + ", which cannot be");
        };
        for (const double origin : file_.origin_mm) require(std::abs(origin) <= 1.01 * most, "the origin", origin);
        require(file_.extent_mm > 0 && file_.extent_mm <= 2.1 * most, "the extent", file_.extent_mm);
        require(file_.step_mm > 0 && file_.step_mm <= 2.1 * most, "the step", file_.step_mm);
        require(file_.ratio > 0 && file_.ratio <= 2, "the ratio", file_.ratio);
    }

    /// The next record, or nothing at the end of all.
    const PaperFiblet* next() {
        if (at_ < block_.size()) return &block_[at_];
        const std::uint64_t left = file_.fiblets - taken_;
        if (left == 0) return nullptr;
        block_.resize(std::size_t(std::min<std::uint64_t>(left, kFiblet76Block)));
        take(std::as_writable_bytes(std::span(block_)), "its fiblets");
        std::uint32_t crc = 0;
        take(std::as_writable_bytes(std::span(&crc, 1)), "a checksum");
        if (crcOf(std::as_bytes(std::span(block_))) != crc) {
            fail("the checksum of fiblets " + std::to_string(taken_) + " to " + std::to_string(taken_ + block_.size() - 1) +
                 " is wrong; the file was changed");
        }
        taken_ += block_.size();
        at_ = 0;
        return block_.data();
    }

    static std::uint32_t fibreOf(const PaperFiblet& fiblet) {
        return std::uint32_t(fiblet[kFibreByte]) | std::uint32_t(fiblet[kFibreByte + 1]) << 8 |
               std::uint32_t(fiblet[kFibreByte + 2]) << 16 | std::uint32_t(fiblet[kFibreByte + 3]) << 24;
    }

    void readFibre() {
        const std::uint64_t fibre = builder_.fibres();
        const PaperFiblet* fiblet = next();
        if (fiblet && fibreOf(*fiblet) < fibre)
            failAt("is of fibre " + std::to_string(fibreOf(*fiblet)) + " after " + std::to_string(fibre));
        if (!fiblet || fibreOf(*fiblet) != fibre) return builder_.endFibre();  // one without points
        for (std::uint32_t index = 0;; ++index) {
            fiblet = next();
            if (!fiblet) fail("ends in the middle of fibre " + std::to_string(fibre));
            const std::uint8_t flags = (*fiblet)[kFlagsByte];
            const std::size_t points = flags >> 2;
            const bool begins = (flags & 1) != 0, ends = (flags & 2) != 0;
            if (fibreOf(*fiblet) != fibre || (*fiblet)[kIndexByte] != index || begins != (index == 0) || points == 0 ||
                points > kPaperPoints || (!ends && (points != kPaperPoints || index == 255))) {
                failAt("is number " + std::to_string((*fiblet)[kIndexByte]) + " of fibre " + std::to_string(fibreOf(*fiblet)) +
                       " with " + std::to_string(points) +
                       " points, which contradicts its flags or what comes before; it would be number " +
                       std::to_string(index) + " of fibre " + std::to_string(fibre));
            }
            for (const glm::dvec3& p : decodePaper(*fiblet, codec_)) {
                builder_.addPoint(glm::vec3(p));
                if (!io::usable(glm::vec3(p))) builder_.damage();
            }
            points_ += points;
            ++at_;
            if (ends) break;
        }
        builder_.endFibre();
    }

    [[noreturn]] void failAt(const std::string& what) const {
        fail("fiblet " + std::to_string(taken_ - block_.size() + at_) + " " + what);
    }

    void checkEnd() {
        if (next()) failAt("is behind the last of " + std::to_string(file_.fibres) + " fibres");
        if (points_ != file_.points) {
            fail("has " + std::to_string(points_) + " points, but its header says " + std::to_string(file_.points));
        }
    }

    io::ByteSource source_;
    model::TractogramHeader header_;
    io::FibreBuilder builder_;
    Fiblet76Header file_{};
    PaperCodec codec_;
    std::vector<PaperFiblet> block_;
    std::size_t at_ = 0;
    std::uint64_t taken_ = 0, points_ = 0;
};

}  // namespace

std::unique_ptr<model::TractogramSource> openFiblet76(const std::filesystem::path& path) {
    return std::make_unique<Fiblet76Source>(path);
}

}  // namespace radiata::ingest
