#include "io/trx.h"

#include <algorithm>

#include "base/error.h"
#include "io/fibre_builder.h"

namespace radiata::io {
namespace {

constexpr std::size_t kBlockNumbers = std::size_t{1} << 16;
constexpr std::size_t kBatchFibres = std::size_t{1} << 16;

/// Numbers of one array as float, from front to back.
class NumberStream {
public:
    NumberStream(const TrxFiles& files, TrxArray array) : array_(std::move(array)) {
        if (!array_.entry.empty()) stream_ = files.open(array_.entry);
    }

    /// Appends `count` numbers.
    void read(std::uint64_t count, std::vector<float>& out) {
        const std::size_t each = bitsOf(array_.type) / 8;
        while (count > 0) {
            const auto block = static_cast<std::size_t>(std::min<std::uint64_t>(count, kBlockNumbers));
            stored_.resize(block * each);
            stream_->read(stored_);
            const std::size_t before = out.size();
            out.resize(before + block);
            decodeSamples(array_.type, false, 1, 0, stored_, std::span(out).subspan(before));
            count -= block;
        }
    }
    const TrxArray& array() const { return array_; }

private:
    TrxArray array_;
    std::unique_ptr<TrxStream> stream_;
    std::vector<std::byte> stored_;
};

/// Begins of streamlines, and the end of the last one.
class OffsetStream {
public:
    OffsetStream(const TrxFiles& files, const TrxHeader& header) : header_(header), name_(files.name()) {
        if (header.fibres == 0) return;
        wide_ = header.offsets.type == SampleType::kUInt64;
        if (!wide_ && header.offsets.type != SampleType::kUInt32) {
            throw Error(Code::kUnsupported, name_ + "/" + header.offsets.entry + ": offsets are uint32 or uint64");
        }
        left_ = files.entries().at(header.offsets.entry).bytes / (wide_ ? 8 : 4);
        stream_ = files.open(header.offsets.entry);
    }

    /// \throws Error(kCorrupt) unless it lies between the one before and the count of vertices
    std::uint64_t next() {
        std::uint64_t value = header_.points;
        if (left_ > 0) {
            if (next_ == block_.size()) fill();
            value = block_[next_++];
            --left_;
        }
        const bool right = count_ == 0 ? value == 0 : value >= before_ && value <= header_.points;
        if (!right || (count_ == header_.fibres && value != header_.points)) {
            throw Error(Code::kCorrupt, name_ + "/" + header_.offsets.entry + ": offset " + std::to_string(count_) + " is " +
                                            std::to_string(value) + "; offsets go from 0 upwards to the " +
                                            std::to_string(header_.points) + " vertices");
        }
        ++count_;
        return before_ = value;
    }

private:
    void fill() {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left_, kBlockNumbers));
        block_.resize(count);
        next_ = 0;
        if (wide_) {
            stream_->read(std::as_writable_bytes(std::span(block_)));
            return;
        }
        narrow_.resize(count);
        stream_->read(std::as_writable_bytes(std::span(narrow_)));
        std::copy(narrow_.begin(), narrow_.end(), block_.begin());
    }

    const TrxHeader& header_;
    std::string name_;
    std::unique_ptr<TrxStream> stream_;
    std::vector<std::uint64_t> block_;
    std::vector<std::uint32_t> narrow_;
    std::size_t next_ = 0;
    std::uint64_t left_ = 0, count_ = 0, before_ = 0;
    bool wide_ = false;
};

class TrxSource : public model::TractogramSource {
public:
    explicit TrxSource(const std::filesystem::path& path)
        : files_(path),
          header_(readTrxHeader(files_)),
          builder_(header_.tractogram),
          positions_(files_, header_.positions),
          offsets_(files_, header_) {
        for (const TrxArray& array : header_.vertex) vertex_.emplace_back(files_, array);
        for (const TrxArray& array : header_.fibre) fibre_.emplace_back(files_, array);
        if (header_.fibres > 0) begin_ = offsets_.next();
    }

    const model::TractogramHeader& header() const override { return header_.tractogram; }

    bool read(model::FibreBatch& batch, std::size_t points_wanted) override {
        builder_.begin(batch);
        const std::uint64_t first = builder_.fibres();
        ends_.clear();
        const std::uint64_t batch_begin = begin_;
        while (first + ends_.size() < header_.fibres && ends_.size() < kBatchFibres &&
               (ends_.empty() || begin_ - batch_begin < points_wanted)) {
            begin_ = offsets_.next();
            ends_.push_back(begin_);
        }
        if (ends_.empty()) return false;
        fill(batch, batch_begin);
        for (std::size_t c = 0; c < fibre_.size(); ++c) {
            fibre_[c].read(ends_.size() * fibre_[c].array().components, batch.fibre_values[c]);
        }
        return true;
    }

    std::vector<model::FibreGroup> groups() override { return readTrxGroups(files_, header_); }
    std::uint64_t damagedFibres() const override { return builder_.damagedFibres(); }
    std::uint64_t bytesRead() const override {
        return header_.points == 0
                   ? 0
                   : static_cast<std::uint64_t>(static_cast<double>(files_.storedBytes()) *
                                                (static_cast<double>(begin_) / static_cast<double>(header_.points)));
    }
    std::uint64_t bytesTotal() const override { return files_.storedBytes(); }

private:
    /// Fibre by fibre, so that memory is taken only for what was there to read.
    void fill(model::FibreBatch& batch, std::uint64_t begin) {
        for (const std::uint64_t end : ends_) {
            for (std::uint64_t done = begin; done < end;) {
                const std::uint64_t block = std::min<std::uint64_t>(end - done, kBlockNumbers);
                numbers_.clear();
                positions_.read(3 * block, numbers_);
                const auto* points = reinterpret_cast<const glm::vec3*>(numbers_.data());
                for (std::uint64_t i = 0; i < block; ++i) {
                    if (!usable(points[i])) builder_.damage();
                }
                builder_.addPoints({points, block});
                done += block;
            }
            for (std::size_t c = 0; c < vertex_.size(); ++c) {
                vertex_[c].read((end - begin) * vertex_[c].array().components, batch.vertex_values[c]);
            }
            builder_.endFibre();
            begin = end;
        }
    }

    TrxFiles files_;
    TrxHeader header_;
    FibreBuilder builder_;
    NumberStream positions_;
    OffsetStream offsets_;
    std::vector<NumberStream> vertex_, fibre_;
    std::vector<std::uint64_t> ends_;
    std::vector<float> numbers_;
    std::uint64_t begin_ = 0;
};

}  // namespace

std::unique_ptr<model::TractogramSource> openTrx(const std::filesystem::path& path) {
    return std::make_unique<TrxSource>(path);
}

}  // namespace radiata::io
