#include "build/fibre_strays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <utility>
#include <vector>

#include "model/fiblet_head.h"

namespace radiata {
namespace {

constexpr std::size_t kSamplesMax = 65536;
/// Of the bound, what half a cell's diagonal may take; the rest is for the codes.
constexpr double kCellShare = 0.9, kCellShareWanted = 0.45;

double cellErrorUm(double cell_mm) { return 1e3 * cell_mm * std::sqrt(3.0) / 2; }

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

std::string pointText(const glm::dvec3& p) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "(%.1f, %.1f, %.1f) mm", p.x, p.y, p.z);
    return text.data();
}

/// Of both middle ones that nearer to the scanner's centre, so that of two fibres the one far out is the stray.
double medianOf(std::vector<double>& values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const double low = values[(values.size() - 1) / 2], high = values[values.size() / 2];
    return std::abs(low) <= std::abs(high) ? low : high;
}

struct Reach {
    std::uint64_t fibres = 0, outside = 0, farthest = 0;
    glm::dvec3 point{0};
    double distance_mm = 0, inner_mm = 0;  ///< of the farthest, and the largest of those inside
};

/// The point of the fibre farthest from the place, and its distance; 0 without points.
std::pair<glm::dvec3, double> farthestOf(std::span<const glm::vec3> fibre, const glm::dvec3& from) {
    std::pair<glm::dvec3, double> most{from, 0};
    for (const glm::vec3& p : fibre) {
        const double distance = glm::distance(glm::dvec3(p), from);
        if (distance > most.second) most = {glm::dvec3(p), distance};
    }
    return most;
}

Reach reachOf(model::TractogramSource& source, const FibreBall& ball, std::size_t batch_points) {
    Reach reach;
    model::FibreBatch batch;
    while (source.read(batch, batch_points)) {
        for (std::size_t f = 0; f < batch.fibreCount(); ++f) {
            const auto [point, distance] = farthestOf(batch.fibre(f), ball.middle_mm);
            if (distance > reach.distance_mm) {
                reach.distance_mm = distance;
                reach.point = point;
                reach.farthest = batch.first_fibre + f;
            }
            if (distance > ball.radius_mm) {
                ++reach.outside;
            } else {
                reach.inner_mm = std::max(reach.inner_mm, distance);
            }
        }
        reach.fibres += batch.fibreCount();
    }
    return reach;
}

class FibresWithin : public model::TractogramSource {
public:
    FibresWithin(std::unique_ptr<model::TractogramSource> source, const FibreBall& ball)
        : source_(std::move(source)), header_(source_->header()), ball_(ball) {
        header_.fibre_count = source_->header().fibre_count;
        header_.point_count.reset();
    }

    const model::TractogramHeader& header() const override { return header_; }

    bool read(model::FibreBatch& batch, std::size_t points_wanted) override {
        if (!source_->read(batch, points_wanted)) {
            if (!std::exchange(told_, true)) tell();
            return false;
        }
        batch.first_point = point_;
        std::size_t to = 0;
        for (std::size_t f = 0; f < batch.fibreCount(); ++f) {
            const std::size_t begin = batch.offsets[f], end = batch.offsets[f + 1];
            const bool keep = farthestOf(batch.fibre(f), ball_.middle_mm).second <= ball_.radius_mm;
            left_out_ += !keep;
            starts_.push_back(to);
            if (!keep) continue;
            move(batch.points, 1, begin, end, to);
            for (std::size_t c = 0; c < batch.vertex_values.size(); ++c)
                move(batch.vertex_values[c], std::size_t(header_.vertex_columns[c].components), begin, end, to);
            to += end - begin;
        }
        starts_.push_back(to);
        batch.offsets.assign(starts_.begin(), starts_.end());
        starts_.clear();
        batch.points.resize(to);
        for (std::size_t c = 0; c < batch.vertex_values.size(); ++c)
            batch.vertex_values[c].resize(to * std::size_t(header_.vertex_columns[c].components));
        point_ += to;
        return true;
    }

    std::vector<model::FibreGroup> groups() override { return source_->groups(); }
    std::uint64_t damagedFibres() const override { return source_->damagedFibres(); }
    std::uint64_t bytesRead() const override { return source_->bytesRead(); }
    std::uint64_t bytesTotal() const override { return source_->bytesTotal(); }

private:
    template <typename T>
    static void move(std::vector<T>& values, std::size_t components, std::size_t begin, std::size_t end, std::size_t to) {
        const auto at = [&](std::size_t i) { return values.begin() + std::ptrdiff_t(i * components); };
        if (begin != to) std::move(at(begin), at(end), at(to));
    }

    void tell() {
        if (left_out_ == 0) return;
        header_.remarks +=
            std::to_string(left_out_) + (left_out_ == 1 ? " fibre reaches" : " fibres reach") + " farther than " +
            number(ball_.radius_mm) + " mm from the middle of the fibres at " + pointText(ball_.middle_mm) +
            (left_out_ == 1 ? " and is left out; it keeps its number. " : " and are left out; they keep their numbers. ");
    }

    std::unique_ptr<model::TractogramSource> source_;
    model::TractogramHeader header_;
    FibreBall ball_;
    std::vector<std::uint64_t> starts_;
    std::uint64_t left_out_ = 0, point_ = 0;
    bool told_ = false;
};

}  // namespace

double fibletCellMm(const glm::dvec3& size_mm) {
    return std::max(std::max({size_mm.x, size_mm.y, size_mm.z}) / model::kFibletCellMax, 1e-6) * (1 + 1e-6);
}

glm::dvec3 middleOfFibres(model::TractogramSource& source, std::size_t batch_points) {
    std::array<std::vector<double>, 3> first;
    model::FibreBatch batch;
    std::uint64_t seen = 0, every = 1;
    while (source.read(batch, batch_points)) {
        for (std::size_t f = 0; f < batch.fibreCount(); ++f) {
            if (batch.fibre(f).empty() || seen++ % every != 0) continue;
            for (int axis = 0; axis < 3; ++axis) first[std::size_t(axis)].push_back(double(batch.fibre(f)[0][axis]));
            if (first[0].size() < kSamplesMax) continue;
            for (std::vector<double>& values : first) {
                for (std::size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
                values.resize(values.size() / 2);
            }
            every *= 2;
        }
    }
    return {medianOf(first[0]), medianOf(first[1]), medianOf(first[2])};
}

void requireNarrowCells(const OpenTractogram& open, const model::TractogramMeasures& measures, double bound_um,
                        std::size_t batch_points) {
    if (measures.points == 0) return;
    const glm::dvec3 size = glm::dvec3(measures.bounds_max) - glm::dvec3(measures.bounds_min);
    const double cell = fibletCellMm(size);
    if (cellErrorUm(cell) <= kCellShare * bound_um) return;
    const double extent = std::max({size.x, size.y, size.z});
    const double wanted = kCellShareWanted * bound_um / cellErrorUm(cell) * extent;
    FibreBall ball{middleOfFibres(*open(), batch_points), wanted / 2};
    const auto source = open();
    const Reach reach = reachOf(*source, ball, batch_points);
    const double enough = std::ceil(100 * cellErrorUm(cell) / kCellShareWanted) / 100;
    const std::string cells = "places are kept in 2^20 cells along the extent of " + number(extent) + " mm, each " +
                              number(1e3 * cell) + " um wide, too much for a bound of " + number(bound_um) + " um; ";
    const StrayFibres plain(source->header().source + ": " + cells + "allow " + number(enough) +
                                " um, or see whether the coordinates are millimetres, if that is not the extent of a brain",
                            ball, reach.outside, reach.fibres);
    if (!plain.few()) throw plain;
    const double within = std::ceil(std::max(reach.inner_mm, 1.0));
    throw StrayFibres(source->header().source + ": fibre " + std::to_string(reach.farthest) + " reaches " +
                          pointText(reach.point) + ", " + number(std::round(reach.distance_mm)) +
                          " mm from the middle of the fibres, of which all but " + std::to_string(reach.outside) +
                          " stay within " + number(within) + " mm; " + cells +
                          "leave out what lies farther (radiata-convert tracts --within " + number(within) + "), or allow " +
                          number(enough) + " um",
                      ball, reach.outside, reach.fibres);
}

std::unique_ptr<model::TractogramSource> fibresWithin(std::unique_ptr<model::TractogramSource> source, const FibreBall& ball) {
    return std::make_unique<FibresWithin>(std::move(source), ball);
}

std::string remarksOf(const model::TractogramSource& source) {
    std::string text = source.header().remarks;
    if (const std::uint64_t damaged = source.damagedFibres(); damaged > 0) {
        text += std::to_string(damaged) +
                (damaged == 1 ? " fibre is left out, but keeps its number: it has"
                              : " fibres are left out, but keep their numbers: they have") +
                " coordinates that are not finite or farther than 100 m from the scanner's centre. ";
    }
    while (text.ends_with(' ')) text.pop_back();
    return text;
}

}  // namespace radiata
