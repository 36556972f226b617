#include "io/tt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/checked.h"
#include "base/error.h"
#include "io/byte_source.h"
#include "io/fibre_builder.h"
#include "io/sample_type.h"
#include "io/text.h"

namespace radiata::io {
namespace {

constexpr double kUnitVoxels = 1.0 / 32;
constexpr std::size_t kBatchFibres = std::size_t{1} << 16;
constexpr std::uint64_t kColumnMax = std::uint64_t{1} << 32;

/// One matrix of a MATLAB version 4 file; the source stands at its first number.
struct Matrix {
    std::string name;
    SampleType type = SampleType::kFloat64;
    bool swapped = false;
    std::uint64_t count = 0, bytes = 0;
};

SampleType typeOf(int digit, const ByteSource& source) {
    constexpr std::array kTypes{SampleType::kFloat64, SampleType::kFloat32, SampleType::kInt32,
                                SampleType::kInt16,   SampleType::kUInt16,  SampleType::kUInt8};
    if (digit < 0 || digit >= static_cast<int>(kTypes.size())) {
        throw Error(Code::kCorrupt, source.name() + ": a matrix before byte " + std::to_string(source.position()) +
                                        " is of type " + std::to_string(digit) + "; MATLAB 4 has types 0 to 5");
    }
    return kTypes[static_cast<std::size_t>(digit)];
}

std::optional<Matrix> nextMatrix(ByteSource& source) {
    std::array<std::uint32_t, 5> head{};  // type, rows, columns, imaginary, length of the name
    const std::size_t got = source.read(std::as_writable_bytes(std::span(head)));
    if (got == 0) return std::nullopt;
    if (got < sizeof(head)) {
        throw Error(Code::kCorrupt, source.name() + ": ends at byte " + std::to_string(source.position()) + " within a matrix");
    }
    // Written by little-endian machines only: DSI Studio has no others.
    if (head[0] >= 100 || head[3] != 0 || head[4] == 0 || head[4] > 256) {
        throw Error(Code::kCorrupt, source.name() + ": no MATLAB 4 matrix ends at byte " + std::to_string(source.position()) +
                                        " (type " + std::to_string(head[0]) + ", name of " + std::to_string(head[4]) +
                                        " bytes)");
    }
    std::string name(head[4], '\0');
    if (source.read(std::as_writable_bytes(std::span(name))) < name.size()) {
        throw Error(Code::kCorrupt, source.name() + ": ends at byte " + std::to_string(source.position()) + " within a name");
    }
    Matrix matrix;
    matrix.name = name.substr(0, name.find('\0'));
    matrix.type = typeOf(static_cast<int>(head[0] / 10), source);
    matrix.count = static_cast<std::uint64_t>(head[1]) * head[2];
    matrix.bytes = checkedMultiply(matrix.count, bitsOf(matrix.type) / 8, source.name());
    source.requireContent(checkedAdd(source.position(), matrix.bytes, source.name()));
    return matrix;
}

std::vector<float> numbersOf(ByteSource& source, const Matrix& matrix) {
    if (matrix.bytes > kColumnMax) {
        throw Error(Code::kResourceExhausted,
                    source.name() + ": the matrix " + shown(matrix.name) + " has " + std::to_string(matrix.bytes) + " bytes");
    }
    constexpr std::size_t kBlock = std::size_t{1} << 16;
    const std::size_t each = bitsOf(matrix.type) / 8;
    std::vector<float> numbers;
    std::vector<std::byte> stored;
    for (std::uint64_t left = matrix.count; left > 0;) {
        const auto block = static_cast<std::size_t>(std::min<std::uint64_t>(left, kBlock));
        stored.resize(block * each);
        if (source.read(stored) < stored.size()) {
            throw Error(Code::kCorrupt, source.name() + ": ends within the matrix " + shown(matrix.name));
        }
        const std::size_t before = numbers.size();
        numbers.resize(before + block);
        decodeSamples(matrix.type, matrix.swapped, 1, 0, stored, std::span(numbers).subspan(before));
        left -= block;
    }
    return numbers;
}

class TtSource : public model::TractogramSource {
public:
    explicit TtSource(const std::filesystem::path& path) : builder_(header_) {
        scan(path);
        source_.emplace(path);
        nextTrackMatrix();
    }

    const model::TractogramHeader& header() const override { return header_; }

    bool read(model::FibreBatch& batch, std::size_t points_wanted) override {
        builder_.begin(batch);
        while (left_ > 0 && batch.fibreCount() < kBatchFibres &&
               (batch.fibreCount() == 0 || batch.points.size() < points_wanted)) {
            readTrack();
            if (left_ == 0) nextTrackMatrix();
        }
        if (batch.fibreCount() == 0 && !cluster_.empty() && cluster_.size() != builder_.fibres()) {
            throw Error(Code::kCorrupt, header_.source + ": the matrix 'cluster' has " + std::to_string(cluster_.size()) +
                                            " numbers for " + std::to_string(builder_.fibres()) + " tracks");
        }
        return batch.fibreCount() > 0;
    }

    std::uint64_t damagedFibres() const override { return builder_.damagedFibres(); }
    std::uint64_t bytesRead() const override { return source_->fileBytesRead(); }
    std::uint64_t bytesTotal() const override { return source_->fileBytes(); }

private:
    /// Everything but the tracks; matrices may stand in any order.
    void scan(const std::filesystem::path& path) {
        ByteSource source(path);
        header_.source = source.name();
        header_.format = "tt";
        std::vector<float> voxel, matrix, dimension;
        bool tracks = false;
        while (const std::optional<Matrix> found = nextMatrix(source)) {
            const std::uint64_t end = source.position() + found->bytes;
            if (found->name.starts_with("track") && found->type == SampleType::kUInt8) tracks = true;
            if (found->name == "voxel_size" && found->count == 3) voxel = numbersOf(source, *found);
            if (found->name == "dimension" && found->count == 3) dimension = numbersOf(source, *found);
            if (found->name == "trans_to_mni" && found->count == 16) matrix = numbersOf(source, *found);
            if (found->name == "cluster") cluster_ = numbersOf(source, *found);
            source.skipTo(end);
        }
        if (!tracks) {
            throw Error(Code::kCorrupt, header_.source + ": has no matrix 'track' of bytes; it is no TinyTrack file");
        }
        if (!cluster_.empty()) header_.fibre_columns = {{"cluster", 1}};
        for (int i = 0; i < 3 && !dimension.empty(); ++i) {
            header_.grid_size[i] = static_cast<int>(std::clamp(dimension[static_cast<std::size_t>(i)], 0.0F, 1e6F));
        }
        place(voxel, matrix);
    }

    void place(const std::vector<float>& voxel, const std::vector<float>& matrix) {
        glm::dmat4 to_world(1.0);
        if (!matrix.empty()) {
            for (int i = 0; i < 16; ++i) to_world[i % 4][i / 4] = matrix[static_cast<std::size_t>(i)];
        } else if (!voxel.empty()) {
            // DSI Studio counts from the left and back to the front; without its matrix nothing says where the head is.
            to_world = glm::dmat4(1.0);
            for (int i = 0; i < 3; ++i)
                to_world[i][i] = (i < 2 ? -1 : 1) * static_cast<double>(voxel[static_cast<std::size_t>(i)]);
            header_.remarks += "The file has no matrix trans_to_mni; tracks are placed by the voxel size alone. ";
        } else {
            throw Error(Code::kCorrupt,
                        header_.source + ": has neither trans_to_mni nor voxel_size, so its tracks have no place");
        }
        for (int i = 0; i < 16; ++i) {
            if (!std::isfinite(to_world[i / 4][i % 4])) {
                throw Error(Code::kCorrupt, header_.source + ": the matrix that places its tracks is not finite");
            }
        }
        header_.voxel_to_world = to_world;
        to_world_ = to_world;
    }

    void nextTrackMatrix() {
        left_ = 0;
        while (const std::optional<Matrix> found = nextMatrix(*source_)) {
            if (found->name.starts_with("track") && found->type == SampleType::kUInt8 && found->bytes > 0) {
                left_ = found->bytes;
                return;
            }
            source_->skipTo(source_->position() + found->bytes);
        }
    }

    void take(std::span<std::byte> out) {
        if (out.size() > left_ || source_->read(out) < out.size()) {
            throw Error(Code::kCorrupt, header_.source + ": the matrix 'track' ends within track " +
                                            std::to_string(builder_.fibres()) + " (byte " +
                                            std::to_string(source_->position()) + " of the content)");
        }
        left_ -= out.size();
    }

    void addPoint(const glm::dvec3& position) {
        const glm::vec3 p(to_world_ * glm::dvec4(position * kUnitVoxels, 1));
        if (!usable(p)) builder_.damage();
        builder_.addPoint(p);
    }

    void readTrack() {
        std::uint32_t count = 0;
        take(std::as_writable_bytes(std::span(&count, 1)));
        if (count == 0 || count % 3 != 0 || (count - 3) + 12ULL > left_) {
            throw Error(Code::kCorrupt, header_.source + ": track " + std::to_string(builder_.fibres()) + " claims " +
                                            std::to_string(count) + " coordinates, " + std::to_string(left_) +
                                            " bytes are left; it must be a multiple of 3 that fits");
        }
        std::array<std::int32_t, 3> first{};
        take(std::as_writable_bytes(std::span(first)));
        steps_.resize(count - 3);
        take(std::as_writable_bytes(std::span(steps_)));
        glm::dvec3 position(first[0], first[1], first[2]);
        addPoint(position);
        for (std::size_t i = 0; i + 2 < steps_.size(); i += 3) {
            position += glm::dvec3(steps_[i], steps_[i + 1], steps_[i + 2]);
            addPoint(position);
        }
        const std::uint64_t fibre = builder_.fibres();
        if (cluster_.empty()) {
            builder_.endFibre();
        } else {
            const float value = fibre < cluster_.size() ? cluster_[fibre] : std::numeric_limits<float>::quiet_NaN();
            builder_.endFibre({&value, 1});
        }
    }

    model::TractogramHeader header_;
    FibreBuilder builder_;
    std::optional<ByteSource> source_;
    glm::dmat4 to_world_{1.0};
    std::vector<float> cluster_;
    std::vector<std::int8_t> steps_;
    std::uint64_t left_ = 0;
};

}  // namespace

std::unique_ptr<model::TractogramSource> openTt(const std::filesystem::path& path) { return std::make_unique<TtSource>(path); }

}  // namespace radiata::io
