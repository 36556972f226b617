#include "reference/path_tracer.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>

#include "reference/sh_function.h"

namespace radiata::reference {
namespace {

constexpr double kFar = 1e9;

class Sampler {
public:
    explicit Sampler(std::uint64_t seed) : random_(seed) {}

    /// Unit, with a density proportional to the cosine with n.
    glm::dvec3 cosineDirection(const glm::dvec3& n) {
        // A point evenly on the sphere around the normal's tip, seen from the normal's foot.
        const double z = 2 * uniform_(random_) - 1, phi = 2 * std::numbers::pi * uniform_(random_);
        const double r = std::sqrt(1 - z * z);
        const glm::dvec3 sum = n + (1 - 1e-9) * glm::dvec3(r * std::cos(phi), r * std::sin(phi), z);
        return glm::normalize(sum);
    }

    /// Evenly from the cone around axis: directions of the whole sphere's cap, turned onto the axis by a reflection.
    glm::dvec3 coneDirection(const glm::dvec3& axis, double cosine) {
        const double z = 1 - (1 - cosine) * uniform_(random_), phi = 2 * std::numbers::pi * uniform_(random_);
        const double r = std::sqrt(std::max(1 - z * z, 0.0));
        const glm::dvec3 d(r * std::cos(phi), r * std::sin(phi), axis.z > 0 ? -z : z);
        const glm::dvec3 mirror = glm::normalize(axis - glm::dvec3(0, 0, axis.z > 0 ? -1 : 1));
        return d - 2 * glm::dot(mirror, d) * mirror;
    }

private:
    std::mt19937_64 random_;
    std::uniform_real_distribution<double> uniform_;
};

/// Where a path goes on from a point of the surface, or nothing if that stays buried.
std::optional<glm::dvec3> liftOff(const ScalarField& field, double iso, const glm::dvec3& p, const glm::dvec3& n) {
    for (double offset = kSurfaceOffset; offset < 1; offset *= 4) {
        const glm::dvec3 lifted = p + offset * n;
        if (!field.holds(lifted) || field.value(lifted) <= iso) return lifted;
    }
    return std::nullopt;
}

double pointIrradiance(const ScalarField& field, double iso, const glm::dvec3& p, const glm::dvec3& n, const Lights& lights,
                       double step) {
    double sum = 0;
    for (const Lights::Point& light : lights.points) {
        const glm::dvec3 towards = light.position - p;
        const double squared = glm::dot(towards, towards), distance = std::sqrt(squared);
        const double cosine = glm::dot(towards, n) / distance;
        if (cosine > 0 && !field.firstCrossing(p, towards / distance, distance, iso, step))
            sum += light.intensity * cosine / squared;
    }
    return sum;
}

double discIrradiance(const ScalarField& field, double iso, const glm::dvec3& p, const glm::dvec3& n, const Lights& lights,
                      double step, Sampler& sampler) {
    double sum = 0;
    for (const Lights::Disc& disc : lights.discs) {
        const glm::dvec3 d = sampler.coneDirection(disc.direction, disc.cosine);
        const double cosine = glm::dot(d, n), sine2 = 1 - disc.cosine * disc.cosine;
        if (cosine <= 0 || field.firstCrossing(p, d, kFar, iso, step)) continue;
        // Radiance irradiance / (pi sin^2), over a solid angle of 2 pi (1 - cos).
        sum += disc.irradiance / (std::numbers::pi * sine2) * 2 * std::numbers::pi * (1 - disc.cosine) * cosine;
    }
    return sum;
}

class Sums {
public:
    explicit Sums(std::size_t count) : sum_(count, 0.0), squares_(count, 0.0) {}
    /// Adds one path's values and clears them.
    void add(std::vector<double>& values) {
        for (std::size_t i = 0; i < sum_.size(); ++i) {
            sum_[i] += values[i];
            squares_[i] += values[i] * values[i];
            values[i] = 0;
        }
        ++paths_;
    }
    PathMeans means() const {
        PathMeans result;
        for (std::size_t i = 0; i < sum_.size(); ++i) {
            const double n = static_cast<double>(paths_), mean = sum_[i] / n;
            result.mean.push_back(mean);
            result.standard_error.push_back(std::sqrt(std::max(squares_[i] / n - mean * mean, 0.0) / (n - 1)));
        }
        return result;
    }

private:
    std::vector<double> sum_, squares_;
    std::uint64_t paths_ = 0;
};

/// Follows paths; at(k, p, n, ...) for the k-th surface point met (0: the first), escaped(k, d) if the k-th point's ray left.
template <typename At, typename Escaped>
PathMeans follow(const ScalarField& field, double iso, const glm::dvec3& start, int bounces, int paths, std::uint64_t seed,
                 double step, std::size_t values, const At& at, const Escaped& escaped) {
    Sampler sampler(seed);
    Sums sums(values);
    std::uint64_t buried = 0;
    std::vector<double> found(values, 0.0);
    for (int path = 0; path < paths; ++path) {
        glm::dvec3 p = start;
        for (int k = 0; k <= bounces; ++k) {
            const glm::dvec3 n = field.outwardNormal(p);
            const std::optional<glm::dvec3> from = liftOff(field, iso, p, n);
            if (!from) {
                ++buried;
                break;
            }
            at(k, *from, n, sampler, found);
            const glm::dvec3 d = sampler.cosineDirection(n);
            const std::optional<double> t = field.firstCrossing(*from, d, kFar, iso, step);
            if (!t) {
                escaped(k, d, found);
                break;
            }
            p = *from + *t * d;
        }
        sums.add(found);
    }
    PathMeans result = sums.means();
    result.buried = buried;
    return result;
}

}  // namespace

PathMeans irradianceByBounce(const ScalarField& field, double iso, const glm::dvec3& p, const Lights& lights, int bounces,
                             int paths, std::uint64_t seed, double step) {
    return follow(
        field, iso, p, bounces, paths, seed, step, static_cast<std::size_t>(bounces + 1),
        [&](int k, const glm::dvec3& from, const glm::dvec3& n, Sampler& sampler, std::vector<double>& found) {
            found[static_cast<std::size_t>(k)] +=
                pointIrradiance(field, iso, from, n, lights, step) + discIrradiance(field, iso, from, n, lights, step, sampler);
        },
        [&](int k, const glm::dvec3& d, std::vector<double>& found) {
            if (lights.sky) found[static_cast<std::size_t>(k)] += std::numbers::pi * lights.sky(d);
        });
}

PathMeans transferByBounce(const ScalarField& field, double iso, const glm::dvec3& p, const std::vector<int>& orders, int paths,
                           std::uint64_t seed) {
    std::vector<std::size_t> first{0};
    std::vector<ShFunction> harmonics;
    for (const int order : orders) {
        first.push_back(first.back() + static_cast<std::size_t>(order * order));
        while (harmonics.size() < static_cast<std::size_t>(order * order)) {
            std::vector<double> one(25, 0.0);
            one[harmonics.size()] = 1;
            harmonics.emplace_back(ShLayout{4, true}, one);
        }
    }
    return follow(
        field, iso, p, static_cast<int>(orders.size()) - 1, paths, seed, 0.1, first.back(),
        [](int, const glm::dvec3&, const glm::dvec3&, Sampler&, std::vector<double>&) {},
        [&](int k, const glm::dvec3& d, std::vector<double>& found) {
            const auto bounce = static_cast<std::size_t>(k);
            for (std::size_t i = first[bounce]; i < first[bounce + 1]; ++i) {
                found[i] = std::numbers::pi * harmonics[i - first[bounce]](d);
            }
        });
}

}  // namespace radiata::reference
