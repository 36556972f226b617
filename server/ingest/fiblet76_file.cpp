#include "ingest/fiblet76_file.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/checked.h"
#include "base/error.h"
#include "build/fiblet_paper.h"
#include "build/fiblet_walk.h"
#include "io/fiblet_layout.h"
#include "io/write_file.h"

namespace radiata::ingest {
namespace {

using io::fiblet::crcOf;

constexpr std::size_t kBatchPoints = std::size_t{1} << 18;

double turnAt(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 u = b - a, v = c - b;
    return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

/// The points that are encoded of each fibre: a whole number of steps.
class Lines {
public:
    Lines(const FibletPlan& plan) : plan_(plan), step_mm_(double(plan.set.codec.step_mm)) {}

    std::span<const glm::vec3> of(std::span<const glm::vec3> fibre) {
        if (fibre.empty()) return fibre;
        std::span<const glm::vec3> points = fibre;
        if (plan_.walk_step_mm > 0) {
            walk(fibre, plan_.walk_step_mm, walked_);
            points = walked_.points;
        }
        if (points.size() < 2) return points;
        const double last = glm::distance(glm::dvec3(points[points.size() - 1]), glm::dvec3(points[points.size() - 2]));
        if (last >= 0.99 * step_mm_) return points;
        if (last < 0.5 * step_mm_) {
            end_mm_ = std::max(end_mm_, last);
            return points.first(points.size() - 1);
        }
        own_.assign(points.begin(), points.end());
        const glm::dvec3 before(points[points.size() - 2]);
        own_.back() = glm::vec3(before + (glm::dvec3(points.back()) - before) * (step_mm_ / last));
        end_mm_ = std::max(end_mm_, step_mm_ - last);
        return own_;
    }
    double endUm() const { return 1e3 * end_mm_; }

private:
    const FibletPlan& plan_;
    double step_mm_, end_mm_ = 0;
    Walk walked_;
    std::vector<glm::vec3> own_;
};

/// Cube and cap that hold all lines.
PaperCodec codecFor(const OpenTractogram& open, const FibletPlan& plan) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    double turn = 1e-3;
    Lines lines(plan);
    model::FibreBatch batch;
    for (const auto source = open(); source->read(batch, kBatchPoints);) {
        for (std::size_t f = 0; f < batch.fibreCount(); ++f) {
            const std::span<const glm::vec3> points = lines.of(batch.fibre(f));
            for (std::size_t i = 0; i < points.size(); ++i) {
                low = glm::min(low, glm::dvec3(points[i]));
                high = glm::max(high, glm::dvec3(points[i]));
                if (i > 1)
                    turn = std::max(turn, turnAt(glm::dvec3(points[i - 2]), glm::dvec3(points[i - 1]), glm::dvec3(points[i])));
            }
        }
    }
    PaperCodec codec;
    codec.step_mm = double(plan.set.codec.step_mm);
    codec.ratio = std::min(1 - std::cos(turn), 2.0);
    if (low.x > high.x) return codec;
    codec.origin_mm = low;
    codec.extent_mm = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-3});
    return codec;
}

class Writer {
public:
    Writer(const std::filesystem::path& path, const PaperCodec& codec) : file_(path), codec_(codec) {
        file_.write(std::as_bytes(std::span(&header_, 1)));
    }

    void add(std::span<const glm::vec3> points, std::uint64_t fibre, const std::string& source) {
        const std::uint64_t count = (points.size() + kPaperPoints - 1) / kPaperPoints;
        if (count > 256) {
            throw Error(Code::kInvalidArgument, source + ": fibre " + std::to_string(fibre) + " has " +
                                                    std::to_string(points.size()) +
                                                    " points; the paper's layout holds at most 15360 of a fibre; a larger "
                                                    "--step needs fewer");
        }
        for (std::uint64_t i = 0; i < count; ++i) {
            const auto piece =
                points.subspan(i * kPaperPoints, std::min<std::size_t>(kPaperPoints, points.size() - i * kPaperPoints));
            block_.push_back(encodePaper(piece, std::uint32_t(fibre), std::uint32_t(i), i == 0, i + 1 == count, codec_,
                                         PaperAim::kPosition));
            measure(piece);
            if (block_.size() == kFiblet76Block) flush();
        }
        header_.points += points.size();
    }

    void finish(std::uint64_t fibres, Fiblet76Written& done) {
        flush();
        if (fibres > fiblet76FibresMax(header_.fiblets)) {
            throw Error(Code::kInvalidArgument, file_.path().string() + ": of " + std::to_string(fibres) +
                                                    " fibres nearly all are without points; a .fiblet76 file of " +
                                                    std::to_string(header_.fiblets) + " fiblets holds at most " +
                                                    std::to_string(fiblet76FibresMax(header_.fiblets)));
        }
        header_.magic = kFiblet76Magic;
        header_.version = 1;
        header_.record_bytes = kPaperBytes;
        header_.fibres = fibres;
        header_.file_bytes =
            sizeof header_ + kPaperBytes * header_.fiblets + 4 * ((header_.fiblets + kFiblet76Block - 1) / kFiblet76Block);
        header_.origin_mm = {codec_.origin_mm.x, codec_.origin_mm.y, codec_.origin_mm.z};
        header_.extent_mm = codec_.extent_mm;
        header_.step_mm = codec_.step_mm;
        header_.ratio = codec_.ratio;
        header_.crc = crcOf(std::as_bytes(std::span(&header_, 1)));
        file_.seek(0);
        file_.write(std::as_bytes(std::span(&header_, 1)));
        file_.finish();
        const double points = double(std::max<std::uint64_t>(header_.points, 1));
        done.fibres = fibres;
        done.fiblets = header_.fiblets;
        done.points = header_.points;
        done.errors = {1e3 * sum_mm_ / points, 1e3 * max_mm_, header_.points};
    }

private:
    void measure(std::span<const glm::vec3> piece) {
        const std::vector<glm::dvec3> decoded = decodePaper(block_.back(), codec_);
        for (std::size_t i = 0; i < piece.size(); ++i) {
            const double error = glm::distance(decoded[i], glm::dvec3(piece[i]));
            sum_mm_ += error;
            max_mm_ = std::max(max_mm_, error);
        }
    }

    void flush() {
        if (block_.empty()) return;
        const auto bytes = std::as_bytes(std::span(block_));
        const std::uint32_t crc = crcOf(bytes);
        file_.write(bytes);
        file_.write(std::as_bytes(std::span(&crc, 1)));
        header_.fiblets += block_.size();
        block_.clear();
    }

    io::WriteFile file_;
    PaperCodec codec_;
    Fiblet76Header header_{};
    std::vector<PaperFiblet> block_;
    double sum_mm_ = 0, max_mm_ = 0;
};

Fiblet76Written writeOnce(const OpenTractogram& open, const FibletOptions& options, const std::filesystem::path& path) {
    const FibletPlan plan = planFiblets(open, options, kBatchPoints, {});
    Writer writer(path, codecFor(open, plan));
    Lines lines(plan);
    const auto source = open();
    std::uint64_t fibres = 0;
    model::FibreBatch batch;
    while (source->read(batch, kBatchPoints)) {
        for (std::size_t f = 0; f < batch.fibreCount(); ++f, ++fibres)
            writer.add(lines.of(batch.fibre(f)), fibres, source->header().source);
    }
    Fiblet76Written done;
    writer.finish(fibres, done);
    done.step_mm = double(plan.set.codec.step_mm);
    done.walked = plan.set.walked;
    done.walk_errors = plan.set.walk_errors;
    done.end_um = lines.endUm();
    done.remarks = remarksOf(*source);
    return done;
}

}  // namespace

bool isFiblet76Name(const std::filesystem::path& path) { return path.extension() == ".fiblet76"; }

Fiblet76Written writeFiblet76(const OpenTractogram& open, const FibletOptions& options, const std::filesystem::path& path) {
    const auto write = [&](const OpenTractogram& of) { return writeOnce(of, options, path); };
    return encodeWithoutStrays(open, options, kBatchPoints, write, [](const StrayFibres&) {});
}

}  // namespace radiata::ingest
