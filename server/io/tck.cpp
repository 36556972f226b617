#include "io/tck.h"

#include <cmath>
#include <cstring>

#include "base/error.h"
#include "io/fibre_builder.h"

namespace radiata::io {
namespace {

constexpr std::size_t kBufferVertices = std::size_t{1} << 16;

class TckSource : public model::TractogramSource {
public:
    explicit TckSource(const std::filesystem::path& path) : numbers_(path, "mrtrix tracks", 3), builder_(header_) {
        header_.source = numbers_.source().name();
        header_.format = "tck";
        header_.fibre_count = numbers_.header().count;
        header_.remarks = numbers_.header().remarks;
    }

    const model::TractogramHeader& header() const override { return header_; }

    bool read(model::FibreBatch& batch, std::size_t points_wanted) override {
        builder_.begin(batch);
        bool between = true;  // no number of the next fibre was taken yet
        while (!ended_ &&
               (!between || batch.points.size() < std::max<std::size_t>(points_wanted, 1) || batch.fibreCount() == 0)) {
            const std::span<const float> numbers = numbers_.buffered();
            if (numbers.empty()) numbers_.failCutOff(builder_.fibres());
            between = takeRun(numbers, between);
            // Fibres without points do not fill a batch.
            if (between && batch.fibreCount() >= kBufferVertices) break;
        }
        return batch.fibreCount() > 0;
    }

    std::uint64_t damagedFibres() const override { return builder_.damagedFibres(); }
    std::uint64_t bytesRead() const override { return numbers_.source().fileBytesRead(); }
    std::uint64_t bytesTotal() const override { return numbers_.source().fileBytes(); }

private:
    /// Takes points up to the first triplet that is none, and that one. \return whether a fibre ended with it
    bool takeRun(std::span<const float> numbers, bool between) {
        static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
        const auto* triplets = reinterpret_cast<const glm::vec3*>(numbers.data());
        const std::size_t count = numbers.size() / 3;
        std::size_t run = 0;
        while (run < count && usable(triplets[run])) ++run;
        if (run > 0) builder_.addPoints({triplets, run});
        if (run == count) {
            numbers_.take(run);
            return false;
        }
        const glm::vec3& other = triplets[run];
        numbers_.take(run + 1);
        if (std::isnan(other.x) && std::isnan(other.y) && std::isnan(other.z)) {
            builder_.endFibre();
            return true;
        }
        if (std::isinf(other.x) && std::isinf(other.y) && std::isinf(other.z)) {
            if (run > 0 || !between) builder_.endFibre();
            ended_ = true;
            return true;
        }
        builder_.damage();
        return false;
    }

    TckNumbers numbers_;
    model::TractogramHeader header_;
    FibreBuilder builder_;
    bool ended_ = false;
};

}  // namespace

TckNumbers::TckNumbers(const std::filesystem::path& path, const std::string& magic, std::size_t width)
    : width_(width), source_(path), header_(readTckHeader(source_, magic)) {
    source_.skipTo(header_.data_begin);
}

std::span<const float> TckNumbers::buffered() {
    if (next_ < numbers_.size()) return std::span(numbers_).subspan(next_);
    next_ = 0;
    numbers_.resize(kBufferVertices * width_);
    const std::size_t number_bytes = bitsOf(header_.type) / 8;
    std::size_t count = 0;
    if (header_.type == SampleType::kFloat32 && !header_.swapped) {
        count = source_.read(std::as_writable_bytes(std::span(numbers_))) / number_bytes;
        numbers_.resize(count - count % width_);
        return numbers_;
    }
    stored_.resize(numbers_.size() * number_bytes);
    count = source_.read(stored_) / number_bytes;
    numbers_.resize(count - count % width_);
    decodeSamples(header_.type, header_.swapped, 1, 0, stored_, numbers_);
    return numbers_;
}

void TckNumbers::failCutOff(std::uint64_t fibre) const {
    throw Error(Code::kCorrupt, source_.name() + ": the file ends at byte " + std::to_string(source_.position()) +
                                    " in fibre " + std::to_string(fibre) +
                                    ", before the infinite numbers that end it; it seems to be cut off");
}

std::unique_ptr<model::TractogramSource> openTck(const std::filesystem::path& path) {
    return std::make_unique<TckSource>(path);
}

}  // namespace radiata::io
