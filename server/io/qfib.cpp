#include "io/qfib.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "base/error.h"
#include "io/byte_source.h"
#include "io/write_file.h"

namespace radiata::io {
namespace {

constexpr std::uint8_t kVersion = 1;
constexpr std::size_t kBatchPoints = std::size_t{1} << 18;
constexpr double kGolden = 1.6180339887498948482, kTwoPi = 6.2831853071795864769;

double signOf(double x) { return x < 0 ? -1 : 1; }

/// Whole numbers of half the bits, signed and symmetric about 0: the first in the upper half.
std::uint16_t octahedralCode(glm::dvec3 v, int bits) {
    const double sum = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
    glm::dvec2 p(v.x / sum, v.y / sum);
    if (v.z < 0) p = {(1 - std::abs(v.y / sum)) * signOf(v.x), (1 - std::abs(v.x / sum)) * signOf(v.y)};
    const int half = bits / 2, most = (1 << (half - 1)) - 1, mask = (1 << half) - 1;
    const int a = int(std::lround(std::clamp(p.x, -1.0, 1.0) * most)), b = int(std::lround(std::clamp(p.y, -1.0, 1.0) * most));
    return std::uint16_t((a & mask) << half | (b & mask));
}

glm::dvec3 octahedralDirection(std::uint16_t code, int bits) {
    const int half = bits / 2, most = (1 << (half - 1)) - 1, mask = (1 << half) - 1;
    const auto part = [&](int value) {
        const int whole = value > most ? value - (1 << half) : value;
        return std::clamp(double(whole) / most, -1.0, 1.0);
    };
    const double x = part(code >> half & mask), y = part(code & mask), z = 1 - std::abs(x) - std::abs(y);
    return glm::normalize(z < 0 ? glm::dvec3((1 - std::abs(y)) * signOf(x), (1 - std::abs(x)) * signOf(y), z)
                                : glm::dvec3(x, y, z));
}

/// Keinert et al. 2015, "Spherical Fibonacci Mapping".
glm::dvec3 fibonacciDirection(std::uint16_t code, int bits) {
    const double count = double(1 << bits), turns = code * kGolden, angle = kTwoPi * (turns - std::floor(turns));
    const double cosine = 1 - 1 / count - 2 * code / count, sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return {std::cos(angle) * sine, std::sin(angle) * sine, cosine};
}

/// The direction about an axis whose 1 - cosine is `scale` times that of v; v itself along the axis.
glm::dvec3 remapped(glm::dvec3 v, glm::dvec3 axis, double scale) {
    const double c = std::clamp(glm::dot(v, axis), -1.0, 1.0);
    const glm::dvec3 across = v - c * axis;
    const double length = glm::length(across);
    if (!(length > 1e-12)) return v;
    const double d = std::clamp(1 - (1 - c) * scale, -1.0, 1.0);
    return glm::normalize(across / length * std::sqrt(1 - d * d) + d * axis);
}

class QfibSource : public model::TractogramSource {
public:
    explicit QfibSource(const std::filesystem::path& path) : source_(path, Packing::kPlain, 0) {
        header_.source = source_.name();
        header_.format = "qfib";
        const auto version = take<std::uint8_t>();
        const auto fibres = take<std::uint32_t>();
        ratio_ = take<float>();
        const auto method = take<std::uint8_t>(), bits = take<std::uint8_t>();
        const auto fail = [&](Code code, const std::string& what) { throw Error(code, header_.source + ": " + what); };
        if (version != kVersion) fail(Code::kUnsupported, "is of version " + std::to_string(version) + "; version 1 is read");
        if (method > 1 || (bits != 8 && bits != 16)) {
            fail(Code::kUnsupported, "has quantisation " + std::to_string(method) + " with " + std::to_string(bits) +
                                         " bits; 0 and 1 with 8 and 16 bits are read");
        }
        if (!(ratio_ > 0 && ratio_ <= 1))
            fail(Code::kCorrupt, "has the ratio " + std::to_string(ratio_) + "; it would have to be above 0, at most 1");
        source_.requireContent(11 + 26ULL * fibres);
        fibonacci_ = method == 1;
        bits_ = bits;
        header_.fibre_count = fibres;
    }

    const model::TractogramHeader& header() const override { return header_; }

    bool read(model::FibreBatch& batch, std::size_t points_wanted) override {
        batch.clear(0, 0);
        batch.first_fibre = fibre_;
        batch.first_point = point_;
        for (; fibre_ < *header_.fibre_count && batch.points.size() < points_wanted; ++fibre_) readFibre(batch);
        point_ += batch.points.size();
        return batch.fibreCount() > 0;
    }
    std::uint64_t damagedFibres() const override { return damaged_; }
    std::uint64_t bytesRead() const override { return bytes_; }
    std::uint64_t bytesTotal() const override { return source_.fileBytes(); }

private:
    template <typename T>
    T take() {
        T value{};
        const auto bytes = std::as_writable_bytes(std::span(&value, 1));
        if (source_.read(bytes) < bytes.size()) {
            throw Error(Code::kCorrupt, header_.source + ": ends in fibre " + std::to_string(fibre_) + "; it is cut off");
        }
        bytes_ += bytes.size();
        return value;
    }

    void readFibre(model::FibreBatch& batch) {
        const auto ends = take<std::array<float, 6>>();
        std::vector<std::uint16_t> codes(take<std::uint16_t>());
        for (std::uint16_t& code : codes) code = bits_ == 16 ? take<std::uint16_t>() : take<std::uint8_t>();
        const auto points =
            decodeQfib({ends[0], ends[1], ends[2]}, {ends[3], ends[4], ends[5]}, codes, ratio_, fibonacci_, bits_);
        const bool sound = std::all_of(points.begin(), points.end(), [](glm::vec3 p) {
            return std::abs(p.x) <= model::kCoordinateMaxMm && std::abs(p.y) <= model::kCoordinateMaxMm &&
                   std::abs(p.z) <= model::kCoordinateMaxMm;
        });
        if (sound) batch.points.insert(batch.points.end(), points.begin(), points.end());
        damaged_ += !sound;
        batch.offsets.push_back(batch.points.size());
    }

    ByteSource source_;
    model::TractogramHeader header_;
    float ratio_ = 0;
    bool fibonacci_ = false;
    int bits_ = 8;
    std::uint64_t fibre_ = 0, point_ = 0, damaged_ = 0, bytes_ = 0;
};

}  // namespace

float qfibRatio(double least_cosine, int bits) {
    const double largest = (1 - least_cosine) / 2;
    double margin = 0;
    for (int i = 0; i < 20; ++i) margin = 3 * std::sqrt(2.0) * std::exp2(-bits / 2.0) * (largest + margin);
    return float(std::min(1.0, largest + std::sqrt(margin)));
}

std::vector<std::uint16_t> encodeQfib(std::span<const glm::vec3> fibre, float ratio, int bits) {
    const glm::dvec3 first(fibre[0]), second(fibre[1]);
    const double step = glm::distance(first, second);
    glm::dvec3 axis = step > 0 ? (second - first) / step : glm::dvec3(0, 0, 1), point = second;
    std::vector<std::uint16_t> codes;
    for (std::size_t i = 2; i < fibre.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(fibre[i]) - point;
        const glm::dvec3 v = glm::length(d) > 0 ? glm::normalize(d) : axis;
        // Outside of the cap, whose rim is the point opposite to the axis: there, a trace towards v.
        const bool outside = (1 - glm::dot(v, axis)) / 2 > double(ratio);
        const std::uint16_t code =
            octahedralCode(outside ? glm::normalize(v * 1e-8 - axis * (1 - 1e-8)) : remapped(v, axis, 1 / double(ratio)), bits);
        codes.push_back(code);
        axis = remapped(octahedralDirection(code, bits), axis, double(ratio));
        point += step * axis;
    }
    return codes;
}

std::vector<glm::vec3> decodeQfib(glm::vec3 first, glm::vec3 second, std::span<const std::uint16_t> codes, float ratio,
                                  bool fibonacci, int bits) {
    const glm::dvec3 a(first), b(second);
    const double step = glm::distance(a, b);
    glm::dvec3 axis = step > 0 ? (b - a) / step : glm::dvec3(0, 0, 1), point = b;
    std::vector<glm::vec3> points{first, second};
    for (const std::uint16_t code : codes) {
        axis = remapped(fibonacci ? fibonacciDirection(code, bits) : octahedralDirection(code, bits), axis, double(ratio));
        point += step * axis;
        points.emplace_back(point);
    }
    return points;
}

std::unique_ptr<model::TractogramSource> openQfib(const std::filesystem::path& path) {
    return std::make_unique<QfibSource>(path);
}

QfibWritten writeQfib(const std::function<std::unique_ptr<model::TractogramSource>()>& open, int bits,
                      const std::filesystem::path& path) {
    double least = 1;
    std::uint64_t fibres = 0;
    model::FibreBatch batch;
    for (const auto source = open(); source->read(batch, kBatchPoints);) {
        for (std::size_t f = 0; f < batch.fibreCount(); ++f, ++fibres) {
            const auto p = batch.fibre(f);
            if (p.size() < 2 || p.size() > 65537) {
                throw Error(Code::kInvalidArgument, source->header().source + ": fibre " + std::to_string(fibres) + " has " +
                                                        std::to_string(p.size()) + " points; a .qfib file holds 2 to 65537");
            }
            for (std::size_t i = 2; i < p.size(); ++i) {
                const glm::dvec3 u = glm::dvec3(p[i - 1]) - glm::dvec3(p[i - 2]), v = glm::dvec3(p[i]) - glm::dvec3(p[i - 1]);
                const double lengths = glm::length(u) * glm::length(v);
                if (lengths > 0) least = std::min(least, glm::dot(u, v) / lengths);
            }
        }
    }
    // Of straight fibres alone it would be 0, which no reader takes.
    const float ratio = std::max(qfibRatio(least, bits), 1e-6F);
    const auto count = std::uint32_t(fibres);
    const std::uint8_t version = kVersion, method = 0, width = std::uint8_t(bits);
    WriteFile file(path);
    const auto put = [&](const auto& value) { file.write(std::as_bytes(std::span(&value, 1))); };
    put(version);
    put(count);
    put(ratio);
    put(method);
    put(width);
    QfibWritten done;
    double sum_mm = 0, max_mm = 0;
    for (const auto source = open(); source->read(batch, kBatchPoints);) {
        for (std::size_t f = 0; f < batch.fibreCount(); ++f) {
            const auto p = batch.fibre(f);
            const std::vector<std::uint16_t> codes = encodeQfib(p, ratio, bits);
            const std::vector<glm::vec3> decoded = decodeQfib(p[0], p[1], codes, ratio, false, bits);
            for (std::size_t i = 0; i < p.size(); ++i) {
                const double error = glm::distance(glm::dvec3(decoded[i]), glm::dvec3(p[i]));
                sum_mm += error;
                max_mm = std::max(max_mm, error);
            }
            ++done.fibres;
            done.points += p.size();
            file.writeNumbers(p.first(2));
            put(std::uint16_t(codes.size()));
            std::vector<std::uint8_t> bytes(codes.begin(), codes.end());
            if (bits == 16) {
                file.writeNumbers(std::span<const std::uint16_t>(codes));
            } else {
                file.writeNumbers(std::span<const std::uint8_t>(bytes));
            }
        }
    }
    file.finish();
    done.mean_um = done.points > 0 ? 1e3 * sum_mm / double(done.points) : 0;
    done.max_um = 1e3 * max_mm;
    return done;
}

}  // namespace radiata::io
