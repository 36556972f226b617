#include "build/phantom_tracts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "build/phantom_random.h"

namespace radiata {
namespace {

constexpr double kReach = 0.85;  // of a strand's radius, so that fibres stay where the bundle fills voxels
constexpr double kTrimMm = 4;    // fibres begin and end up to this far from the strand's ends
constexpr std::size_t kBatchFibres = 4096;

/// A strand with two directions across it that turn as little as the curve allows.
struct Course {
    const phantom::Strand* strand;
    int bundle;  ///< index
    std::vector<glm::dvec3> across, up;
};

Course courseOf(const phantom::Strand& strand, int bundle) {
    Course course{&strand, bundle, {}, {}};
    glm::dvec3 side = std::abs(strand.tangents[0].x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    for (const glm::dvec3& tangent : strand.tangents) {
        side = glm::normalize(side - glm::dot(side, tangent) * tangent);
        course.across.push_back(side);
        course.up.push_back(glm::cross(tangent, side));
    }
    return course;
}

/// Points at a constant distance from each other along a polyline; the end is kept.
void walk(const std::vector<glm::dvec3>& line, double step, std::vector<glm::vec3>& points) {
    glm::dvec3 at = line.front();
    points.emplace_back(at);
    for (std::size_t i = 0; i + 1 < line.size();) {
        const glm::dvec3 o = line[i] - at, d = line[i + 1] - line[i];
        // The last place on this piece that is one step away, if any.
        const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - step * step;
        const double root2 = b * b - a * c;
        const double t = a > 0 && root2 >= 0 ? (-b + std::sqrt(root2)) / a : 2;
        if (t > 1 || t < 0) {
            ++i;
            continue;
        }
        at = line[i] + t * d;
        points.emplace_back(at);
    }
    if (glm::distance(at, line.back()) > 1e-3 * step) points.emplace_back(line.back());
}

/// Catmull-Rom between points 1 mm apart, so that a course has no corners.
std::vector<glm::dvec3> smoothed(const std::vector<glm::dvec3>& points, double spacing) {
    std::vector<glm::dvec3> fine;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const glm::dvec3 &p1 = points[i], &p2 = points[i + 1];
        const glm::dvec3 p0 = i > 0 ? points[i - 1] : 2.0 * p1 - p2, p3 = i + 2 < points.size() ? points[i + 2] : 2.0 * p2 - p1;
        const int pieces = std::max(1, static_cast<int>(std::ceil(glm::distance(p1, p2) / spacing)));
        for (int k = 0; k < pieces; ++k) {
            const double t = static_cast<double>(k) / pieces;
            fine.push_back(p1 +
                           0.5 * t * (p2 - p0 + t * (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3 + t * (3.0 * (p1 - p2) + p3 - p0))));
        }
    }
    fine.push_back(points.back());
    return fine;
}

class PhantomTracts : public model::TractogramSource {
public:
    PhantomTracts(const Phantom& phantom, const PhantomTractOptions& options)
        : options_(options), seed_(phantom.options().seed), bundles_(phantom.field().bundles()), members_(bundles_.size()) {
        if (!(options.step_mm >= 0.01 && options.step_mm <= 10)) {
            throw Error(Code::kInvalidArgument, "step is " + std::to_string(options.step_mm) + " mm; it must be 0.01 to 10");
        }
        if (options.fibres == 0 || options.fibres > model::kFibreCountMax) {
            throw Error(Code::kInvalidArgument, "fibres is " + std::to_string(options.fibres) + "; it must be 1 to " +
                                                    std::to_string(model::kFibreCountMax));
        }
        header_.source = "phantom";
        header_.format = "phantom";
        header_.fibre_count = options.fibres;
        header_.vertex_columns = {{"along", 1}};
        header_.fibre_columns = {{"bundle", 1}};
        header_.grid_size = phantom.grid().size;
        header_.voxel_to_world = phantom.grid().voxel_to_world;
        for (std::size_t b = 0; b < bundles_.size(); ++b) {
            for (const phantom::Strand& strand : bundles_[b].strands) {
                courses_.push_back(courseOf(strand, static_cast<int>(b)));
                const double radius = strand.radii[strand.radii.size() / 2];
                shares_.push_back((shares_.empty() ? 0 : shares_.back()) + radius * radius);
            }
        }
    }

    const model::TractogramHeader& header() const override { return header_; }

    bool read(model::FibreBatch& batch, std::size_t points_wanted) override {
        batch.clear(1, 1);
        batch.first_fibre = next_;
        batch.first_point = points_;
        while (next_ < options_.fibres && batch.fibreCount() < kBatchFibres &&
               (batch.fibreCount() == 0 || batch.points.size() < points_wanted)) {
            addFibre(batch);
        }
        points_ += batch.points.size();
        return batch.fibreCount() > 0;
    }

    std::vector<model::FibreGroup> groups() override {
        std::vector<model::FibreGroup> groups;
        for (std::size_t b = 0; b < bundles_.size(); ++b) groups.push_back({bundles_[b].name, members_[b], {}, {}});
        return groups;
    }

private:
    void addFibre(model::FibreBatch& batch) {
        const auto draw = [&](std::uint64_t n) { return phantom::uniform(seed_, 8 * next_ + n); };
        const double chosen = draw(0) * shares_.back();
        const auto index = static_cast<std::size_t>(std::lower_bound(shares_.begin(), shares_.end(), chosen) - shares_.begin());
        const Course& course = courses_[std::min(index, courses_.size() - 1)];
        const double reach = kReach * std::sqrt(draw(1)), angle = 2 * std::numbers::pi * draw(2);
        const std::size_t count = course.strand->points.size();
        const auto trim = [&](double share) { return std::min(static_cast<std::size_t>(kTrimMm * share), count / 4); };
        std::vector<glm::dvec3> line;
        for (std::size_t i = trim(draw(3)); i + trim(draw(4)) < count; ++i) {
            // A slow turn around the strand, as fibres in a bundle have.
            const double turn = angle + 0.6 * std::sin(0.03 * static_cast<double>(i) + 6 * draw(5));
            line.push_back(course.strand->points[i] + reach * course.strand->radii[i] *
                                                          (std::cos(turn) * course.across[i] + std::sin(turn) * course.up[i]));
        }
        const std::size_t first = batch.points.size();
        walk(smoothed(line, std::min(0.5, 0.5 * options_.step_mm)), options_.step_mm, batch.points);
        const auto last = static_cast<float>(std::max<std::size_t>(batch.points.size() - first, 2) - 1);
        for (std::size_t i = first; i < batch.points.size(); ++i) {
            batch.vertex_values[0].push_back(static_cast<float>(i - first) / last);
        }
        const auto bundle = static_cast<std::size_t>(course.bundle);
        batch.fibre_values[0].push_back(static_cast<float>(bundles_[bundle].id));
        batch.offsets.push_back(batch.points.size());
        members_[bundle].push_back(static_cast<std::uint32_t>(next_));
        ++next_;
    }

    PhantomTractOptions options_;
    std::uint64_t seed_;
    const std::vector<phantom::Bundle>& bundles_;
    std::vector<std::vector<std::uint32_t>> members_;
    model::TractogramHeader header_;
    std::vector<Course> courses_;
    std::vector<double> shares_;
    std::uint64_t next_ = 0, points_ = 0;
};

}  // namespace

std::unique_ptr<model::TractogramSource> phantomTracts(const Phantom& phantom, const PhantomTractOptions& options) {
    return std::make_unique<PhantomTracts>(phantom, options);
}

}  // namespace radiata
