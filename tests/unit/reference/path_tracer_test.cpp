// Path tracing of level sets against scenes whose illumination is known in closed form. Bounds are standard errors of the paths
// (4.5 of them; each test has a few dozen comparisons) plus what the grid rounds off.
#include "reference/path_tracer.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "math/sh_evaluate.h"

namespace radiata::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kErrors = 4.5;

/// A point of the level set on the ray from `from` in direction d.
glm::dvec3 onSurface(const ScalarField& field, const glm::dvec3& from, const glm::dvec3& d, double iso) {
    return from + field.firstCrossing(from, glm::normalize(d), 1e3, iso).value() * glm::normalize(d);
}

double constantSky(const glm::dvec3&) { return 1; }

TEST(PathTracer, LightInTheCentreOfAClosedSphere) {
    // E_k = I / r^2 for every k: the sphere sees nothing but itself, and every point gets the same.
    const glm::dvec3 centre(15.5);
    const ScalarField field(glm::ivec3(32), [&](const glm::dvec3& p) { return glm::length(p - centre); });
    Lights lights;
    lights.points.push_back({centre, 50});
    const double radius = 12;
    for (const glm::dvec3& d : {glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 1), glm::dvec3(-0.3, 0.8, 0.2)}) {
        const glm::dvec3 p = onSurface(field, centre, d, radius);
        const PathMeans found = irradianceByBounce(field, radius, p, lights, 3, 300, 5);
        for (std::size_t k = 0; k < 4; ++k) {
            // Trilinear distances are up to 1 / (4 r) = 0.02 voxels too large, and paths start 0.02 nearer to the light: 0.7 %.
            EXPECT_NEAR(found.mean[k], 50 / (radius * radius),
                        0.007 * 50 / (radius * radius) + kErrors * found.standard_error[k])
                << k;
        }
        EXPECT_EQ(found.buried, 0u);
    }
}

/// A ball cut out of a half space, so that a fraction `open` of the ball's area is the opening.
ScalarField cavity(int size, double open, glm::dvec3& centre, double& radius) {
    centre = glm::dvec3(0.5 * (size - 1));
    radius = 0.3 * size;
    const double top = centre.z + radius * (1 - 2 * open);
    return ScalarField(glm::ivec3(size), [=](const glm::dvec3& p) {
        return std::min(top - p.z, glm::length(p - centre) - radius);  // above 0: solid
    });
}

TEST(PathTracer, CavityWithAnOpeningNearsItsClosedFormWithTheGrid) {
    // Form factors in a sphere are constant, so E_k / pi = s (1 - s)^k at every point of the wall, s the opening's share.
    // Trilinear data round the rim off, which opens it further: an error of first order in the grid's spacing.
    const double open = 0.2;
    double error[2];
    for (int i = 0; i < 2; ++i) {
        glm::dvec3 centre;
        double radius = 0;
        const ScalarField field = cavity(24 << i, open, centre, radius);
        error[i] = 0;
        for (const glm::dvec3& d : {glm::dvec3(0.3, 0.1, -1), glm::dvec3(1, 0.4, -0.3)}) {
            const PathMeans found = irradianceByBounce(field, 0, onSurface(field, centre, d, 0), {constantSky, {}}, 2, 3000, 6);
            double expected = open;
            for (std::size_t k = 0; k < 3; ++k, expected *= 1 - open) {
                const double off = found.mean[k] / kPi - expected;
                EXPECT_LT(std::abs(off), 0.09 / (1 << i) * open / 0.2 + kErrors * found.standard_error[k] / kPi) << k;
                if (k == 0) error[i] += off / 2;
            }
        }
    }
    EXPECT_GT(error[0], error[1]) << "the rim is rounder on the coarse grid";
}

TEST(PathTracer, WhiteFurnaceIsEvenlyLit) {
    // A sky of 1 and white surfaces: all light that leaves comes in somewhere, so E = pi everywhere, however deep the cavity.
    glm::dvec3 centre;
    double radius = 0;
    const ScalarField field = cavity(24, 0.2, centre, radius);
    for (const glm::dvec3& d : {glm::dvec3(0.3, 0.1, -1), glm::dvec3(1, 0.4, -0.3)}) {
        const PathMeans found = irradianceByBounce(field, 0, onSurface(field, centre, d, 0), {constantSky, {}}, 60, 1000, 7);
        double sum = 0;
        for (const double mean : found.mean) sum += mean / kPi;
        // Every path ends in the sky but those buried: less than one in a thousand.
        EXPECT_NEAR(sum, 1, 0.001);
        EXPECT_LT(found.mean[0] / kPi, 0.3);
    }
}

TEST(PathTracer, TransferOfAConvexSurfaceIsTheCosineLobe) {
    // In units of pi: 1, 2/3, 1/4, 0, -1/24 times Y_lm(n) for bands 0 to 4, and nothing that bounced.
    const glm::dvec3 centre(11.5);
    const ScalarField field(glm::ivec3(24), [&](const glm::dvec3& p) { return 8 - glm::length(p - centre); });
    const double lobe[5] = {1, 2.0 / 3, 0.25, 0, -1.0 / 24};
    const glm::dvec3 d = glm::normalize(glm::dvec3(0.4, -0.7, 0.5));
    const glm::dvec3 p = onSurface(field, centre + 11.0 * d, -d, 0), n = field.outwardNormal(p);
    EXPECT_GT(glm::dot(n, d), 0.9999);
    const PathMeans found = transferByBounce(field, 0, p, {5, 2}, 20000, 8);
    std::vector<double> y(25);
    evaluateSh(ShLayout{4, true}, n, y);
    std::size_t i = 0;
    for (int l = 0; l < 5; ++l) {
        for (int m = -l; m <= l; ++m, ++i) {
            EXPECT_NEAR(found.mean[i], kPi * lobe[l] * y[i], 0.01 + kErrors * found.standard_error[i]) << l << ", " << m;
        }
    }
    for (; i < found.mean.size(); ++i) EXPECT_NEAR(found.mean[i], 0, 0.02) << "trilinear spheres have dents of 0.01 voxel";
}

TEST(PathTracer, FloorBesideALongWall) {
    // E / pi = (1 + cos(atan(h / d))) / 2 on a floor at distance d from a wall of height h, under an even sky.
    const ScalarField field(glm::ivec3(40, 96, 24),
                            [](const glm::dvec3& p) { return std::max(4 - p.z, std::min(10 - p.x, 16 - p.z)); });
    for (const double distance : {6.0, 12.0}) {
        const double height = 12;
        const PathMeans found = irradianceByBounce(field, 0, glm::dvec3(10 + distance, 47.5, 4), {constantSky, {}}, 0, 6000, 9);
        // The wall ends 48 voxels away on both sides; what is seen beyond its ends is below 1.5 %.
        EXPECT_NEAR(found.mean[0] / kPi, (1 + std::cos(std::atan(height / distance))) / 2,
                    0.015 + kErrors * found.standard_error[0] / kPi);
    }
}

TEST(PathTracer, GradientSkyOnAnUpwardPlane) {
    // E / pi = a + 2 b / 3 under a sky of a + b z.
    const ScalarField field(glm::ivec3(12), [](const glm::dvec3& p) { return 5.3 - p.z; });
    const Lights lights{[](const glm::dvec3& d) { return 0.7 + 0.4 * d.z; }, {}};
    const PathMeans found = irradianceByBounce(field, 0, glm::dvec3(6, 6, 5.3), lights, 1, 20000, 10);
    EXPECT_NEAR(found.mean[0] / kPi, 0.7 + 2 * 0.4 / 3, kErrors * found.standard_error[0] / kPi);
    EXPECT_EQ(found.mean[1], 0) << "a plane does not see itself";
}

TEST(PathTracer, DiscsThatAreLookedForAreThoseThatAreMetByChance) {
    // In a cavity that the disc shines into, on its rim's light and shadow: the first point and what bounces.
    const glm::dvec3 centre(11.5), towards = glm::normalize(glm::dvec3(0.4, -0.2, 0.9));
    const ScalarField field(glm::ivec3(24), [&](const glm::dvec3& p) {
        return std::min(8 - glm::length(p - centre), glm::length(p - centre - glm::dvec3(0, 0, 8)) - 6);
    });
    const double cosine = std::cos(0.4), sine2 = 1 - cosine * cosine;
    const auto sky = [&](const glm::dvec3& d) { return glm::dot(d, towards) > cosine ? 2 / (kPi * sine2) : 0.0; };
    const glm::dvec3 p = onSurface(field, centre + glm::dvec3(0, 0, 11), {0.1, 0, -1}, 0);
    const PathMeans met = irradianceByBounce(field, 0, p, {sky, {}}, 1, 20000, 12);
    const PathMeans sought = irradianceByBounce(field, 0, p, {{}, {}, {{towards, cosine, 2}}}, 1, 2000, 13);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(sought.mean[k], met.mean[k], kErrors * std::hypot(sought.standard_error[k], met.standard_error[k])) << k;
        EXPECT_LT(sought.standard_error[k], 3 * met.standard_error[k]) << "from a tenth of the paths";
    }
    EXPECT_GT(sought.mean[0], 1);
}

TEST(PathTracer, IsLinearInTheLight) {
    const glm::dvec3 centre(11.5);
    const ScalarField field(glm::ivec3(24), [&](const glm::dvec3& p) {
        return std::min(8 - glm::length(p - centre), glm::length(p - centre - glm::dvec3(0, 0, 8)) - 6);
    });
    const auto up = [](const glm::dvec3& d) { return std::max(d.z, 0.0); };
    const auto both = [&](const glm::dvec3& d) { return 2 * constantSky(d) + 3 * up(d); };
    const glm::dvec3 p = onSurface(field, centre + glm::dvec3(0, 0, 11), {0.1, 0, -1}, 0);
    const PathMeans first = irradianceByBounce(field, 0, p, {constantSky, {}}, 2, 500, 11);
    const PathMeans second = irradianceByBounce(field, 0, p, {up, {}}, 2, 500, 11);
    const PathMeans sum = irradianceByBounce(field, 0, p, {both, {}}, 2, 500, 11);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(sum.mean[k], 2 * first.mean[k] + 3 * second.mean[k], 1e-12);
}

TEST(PathTracer, VicinityIsTheFirstCoefficientOfTransfer) {
    // Stewart's vicinity is the irradiance of no bounces under a constant sky over pi: sqrt(4 pi) / pi times the coefficient of
    // band 0, path by path.
    glm::dvec3 centre;
    double radius = 0;
    const ScalarField field = cavity(24, 0.3, centre, radius);
    const glm::dvec3 p = onSurface(field, centre, {0.5, 0.2, -0.6}, 0);
    const double vicinity = irradianceByBounce(field, 0, p, {constantSky, {}}, 0, 1000, 12).mean[0] / kPi;
    EXPECT_NEAR(transferByBounce(field, 0, p, {1}, 1000, 12).mean[0] * std::sqrt(4 * kPi) / kPi, vicinity, 1e-12);
}

}  // namespace
}  // namespace radiata::reference
