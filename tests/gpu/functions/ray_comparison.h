// Rays against random glyphs: what a solver in a shader finds against the exhaustive search of the reference.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "reference/glyph_hits.h"
#include "shaders/test/ray_io.glsl"

namespace radiata::test {

using shader::RayInput;
using shader::RayOutput;

using Solve = std::function<std::vector<RayOutput>(const std::vector<float>& glyph, const std::vector<RayInput>& rays)>;

/// A glyph of amplitude about 1: falling coefficients, mostly positive.
inline std::vector<float> randomGlyph(std::mt19937& random, ShLayout layout) {
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<float> coefficients(layout.count());
    for (int l = 0; l <= layout.lmax; l += layout.step()) {
        for (int m = -l; m <= l; ++m) coefficients[layout.index(l, m)] = unit(random) / float(1 + l);
    }
    coefficients[0] = 0.6F;
    return coefficients;
}

/// Rays from distance 3 that pass the centre at `nearest` to `farthest`.
inline std::vector<RayInput> randomRays(std::mt19937& random, std::size_t count, float nearest, float farthest) {
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<RayInput> rays(count);
    for (RayInput& ray : rays) {
        ray.direction = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        const glm::vec3 side = glm::normalize(glm::cross(ray.direction, glm::vec3(normal(random), normal(random), 1)));
        ray.origin = -3.0F * ray.direction + (nearest + (farthest - nearest) * unit(random)) * side;
        ray.t_min = 0;
        ray.both_lobes = unit(random) < 0.5F;
    }
    return rays;
}

inline reference::GlyphHits truth(const reference::ShFunction& f, const RayInput& ray) {
    return reference::glyphHits(f, ray.origin, glm::normalize(glm::dvec3(ray.direction)), ray.both_lobes != 0, ray.t_min);
}

struct Comparison {
    int rays = 0;
    int wrong = 0;  // missed, invented, of the wrong sign, or off by more than the bound
    double worst = 0;
};

inline void printRay(const RayInput& ray, const RayOutput& output, const reference::GlyphHits& expected) {
    std::printf("  ray (%.9g, %.9g, %.9g) + t (%.9g, %.9g, %.9g), t >= %g, %s: t %.9g amplitude %.9g", ray.origin.x,
                ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z, ray.t_min,
                ray.both_lobes ? "both lobes" : "positive lobes", output.t, output.amplitude);
    if (expected.hits.empty())
        std::printf(", expected none\n");
    else
        std::printf(", expected t %.9g amplitude %.9g\n", expected.hits[0].t, expected.hits[0].amplitude);
}

/// Leaves out rays whose first hit moves by more than 1e-3 radii when the ray moves by 1e-5.
inline Comparison compare(const std::vector<float>& glyph, ShLayout layout, const std::vector<RayInput>& rays,
                          const std::vector<RayOutput>& outputs, double bound) {
    const reference::ShFunction f(layout, glyph);
    Comparison result;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const reference::GlyphHits expected = truth(f, rays[i]);
        if (!(expected.first_shift < 1e-3)) continue;
        ++result.rays;
        const bool hit = outputs[i].amplitude != 0;
        bool wrong = hit != !expected.hits.empty();
        if (hit && !wrong) {
            const double error = std::abs(outputs[i].t - expected.hits[0].t);
            const bool same_sign = (outputs[i].amplitude > 0) == (expected.hits[0].amplitude > 0);
            wrong = !(error < bound) || !same_sign;
            result.worst = std::max(result.worst, error);
        }
        result.wrong += wrong;
        if (wrong && result.wrong <= 3) printRay(rays[i], outputs[i], expected);
    }
    return result;
}

struct Region {
    float nearest, farthest;  // distance of the rays from the centre
};

/// Three glyphs of 300 rays each.
inline Comparison compareRegion(const Solve& solve, ShLayout layout, Region region, double bound, bool from_inside = false) {
    std::mt19937 random(12);
    Comparison sum;
    for (int i = 0; i < 3; ++i) {
        const std::vector<float> glyph = randomGlyph(random, layout);
        std::vector<RayInput> rays = randomRays(random, 300, region.nearest, region.farthest);
        if (from_inside) {
            for (RayInput& ray : rays) ray.origin += 2.9F * ray.direction;
        }
        const Comparison part = compare(glyph, layout, rays, solve(glyph, rays), bound);
        sum = {sum.rays + part.rays, sum.wrong + part.wrong, std::max(sum.worst, part.worst)};
    }
    std::printf("%s %2d  distance %g to %g: %d rays, %d wrong, worst error %.2g\n", layout.full ? "full" : "even", layout.lmax,
                double(region.nearest), double(region.farthest), sum.rays, sum.wrong, sum.worst);
    return sum;
}

}  // namespace radiata::test
