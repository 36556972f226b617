#include "io/trk.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/error.h"
#include "io/fibre_builder.h"
#include "io/sample_type.h"
#include "io/trk_header.h"

namespace radiata::io {
namespace {

constexpr std::size_t kBlockPoints = std::size_t{1} << 12;
constexpr std::size_t kBatchFibres = std::size_t{1} << 16;

class TrkSource : public model::TractogramSource {
public:
    explicit TrkSource(const std::filesystem::path& path)
        : source_(path), header_(readTrkHeader(source_)), builder_(header_.tractogram), properties_(header_.properties) {}

    const model::TractogramHeader& header() const override { return header_.tractogram; }

    bool read(model::FibreBatch& batch, std::size_t points_wanted) override {
        builder_.begin(batch);
        do {
            const std::int64_t points = nextCount();
            if (points < 0) break;
            readPoints(static_cast<std::size_t>(points), batch);
            readFloats(properties_, "properties");
            builder_.endFibre(properties_);
        } while (batch.points.size() < points_wanted && batch.fibreCount() < kBatchFibres);
        return batch.fibreCount() > 0;
    }

    std::uint64_t damagedFibres() const override { return builder_.damagedFibres(); }
    std::uint64_t bytesRead() const override { return source_.fileBytesRead(); }
    std::uint64_t bytesTotal() const override { return source_.fileBytes(); }

private:
    /// -1 at the end of the file.
    std::int64_t nextCount() {
        std::array<std::byte, 4> bytes{};
        const std::size_t got = source_.read(bytes);
        if (got == 0) return -1;
        if (got < bytes.size()) failCutOff("count of points");
        if (header_.swapped) std::reverse(bytes.begin(), bytes.end());
        std::int32_t count = 0;
        std::memcpy(&count, bytes.data(), sizeof(count));
        if (count < 0) {
            throw Error(Code::kCorrupt, source_.name() + ": track " + std::to_string(builder_.fibres()) + " at byte " +
                                            std::to_string(source_.position() - 4) + " claims " + std::to_string(count) +
                                            " points; a count must not be negative");
        }
        return count;
    }

    void readFloats(std::span<float> out, const char* what) {
        stored_.resize(out.size() * sizeof(float));
        if (source_.read(stored_) < stored_.size()) failCutOff(what);
        decodeSamples(SampleType::kFloat32, header_.swapped, 1, 0, stored_, out);
    }

    void readPoints(std::size_t count, model::FibreBatch& batch) {
        const std::size_t width = 3 + header_.scalars;
        for (std::size_t done = 0; done < count;) {
            const std::size_t block = std::min(kBlockPoints, count - done);
            numbers_.resize(block * width);
            readFloats(numbers_, "points");
            for (std::size_t i = 0; i < block; ++i) {
                const float* vertex = numbers_.data() + i * width;
                const glm::vec3 p(header_.to_world * glm::dvec4(vertex[0], vertex[1], vertex[2], 1));
                if (!usable(p)) builder_.damage();
                builder_.addPoint(p);
                addScalars(vertex + 3, batch);
            }
            done += block;
        }
    }

    void addScalars(const float* values, model::FibreBatch& batch) const {
        for (std::size_t c = 0; c < batch.vertex_values.size(); ++c) {
            const int components = header_.tractogram.vertex_columns[c].components;
            batch.vertex_values[c].insert(batch.vertex_values[c].end(), values, values + components);
            values += components;
        }
    }

    [[noreturn]] void failCutOff(const char* what) const {
        throw Error(Code::kCorrupt, source_.name() + ": the file ends at byte " + std::to_string(source_.position()) +
                                        ", within the " + what + " of track " + std::to_string(builder_.fibres()));
    }

    ByteSource source_;
    TrkHeader header_;
    FibreBuilder builder_;
    std::vector<float> properties_, numbers_;
    std::vector<std::byte> stored_;
};

}  // namespace

std::unique_ptr<model::TractogramSource> openTrk(const std::filesystem::path& path) {
    return std::make_unique<TrkSource>(path);
}

}  // namespace radiata::io
