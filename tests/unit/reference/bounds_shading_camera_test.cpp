#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "random_glyphs.h"
#include "reference/camera_rays.h"
#include "reference/glyph_bounds.h"
#include "reference/shading.h"

namespace radiata::reference {
namespace {

using test::randomCoefficients;
using test::uniform;
using test::unitVector;

TEST(GlyphBounds, OfABandOneGlyphAreKnown) {
    // f = z: positive lobe = sphere of diameter 1 on the origin; extents 1/2 sideways, 1 upwards.
    const ShFunction f({1, true}, std::vector<double>{0, 0, std::sqrt(4 * std::numbers::pi / 3), 0});
    const GlyphBounds positive = glyphBounds(f, false);
    EXPECT_NEAR(positive.radius, 1, 1e-13);
    EXPECT_LT(glm::length(positive.max - glm::dvec3(0.5, 0.5, 1)), 1e-12);
    EXPECT_LT(glm::length(positive.min - glm::dvec3(-0.5, -0.5, 0)), 1e-12);
    EXPECT_LT(glm::length(glyphBounds(f, true).min - glm::dvec3(-0.5, -0.5, -1)), 1e-12);
}

TEST(GlyphBounds, HoldAndAreTouched) {
    std::mt19937_64 random(8);
    for (const ShLayout layout : {ShLayout{4, false}, ShLayout{16, false}, ShLayout{6, true}}) {
        const ShFunction f(layout, randomCoefficients(random, layout));
        for (const bool both : {false, true}) {
            const GlyphBounds bounds = glyphBounds(f, both);
            glm::dvec3 highest(0);
            for (int i = 0; i < 20000; ++i) {
                const glm::dvec3 p = unitVector(random);
                const double radius = both ? std::abs(f(p)) : std::max(f(p), 0.0);
                EXPECT_LE(radius, bounds.radius);
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_LE(radius * p[axis], bounds.max[axis]);
                    EXPECT_GE(radius * p[axis], bounds.min[axis]);
                    highest[axis] = std::max(highest[axis], radius * p[axis]);
                }
            }
            for (int axis = 0; axis < 3; ++axis) EXPECT_GT(highest[axis], 0.98 * bounds.max[axis]);
        }
    }
}

TEST(DielectricBrdf, ReflectsLessThanItReceivesAndIsReciprocal) {
    std::mt19937_64 random(9);
    const glm::dvec3 normal(0, 0, 1);
    for (const double viewer_z : {0.1, 0.5, 1.0}) {
        const glm::dvec3 viewer(std::sqrt(1 - viewer_z * viewer_z), 0, viewer_z);
        double albedo = 0;
        const int samples = 20000;
        for (int i = 0; i < samples; ++i) {
            glm::dvec3 light = unitVector(random);
            light.z = std::abs(light.z);
            albedo += dielectricBrdfCosine(glm::dvec3(0.5), 0.45, normal, viewer, light).x * 2 * std::numbers::pi / samples;
            const double there = dielectricBrdfCosine(glm::dvec3(0.5), 0.45, normal, viewer, light).y / light.z;
            const double back = dielectricBrdfCosine(glm::dvec3(0.5), 0.45, normal, light, viewer).y / viewer.z;
            if (light.z > 0.01) {
                EXPECT_NEAR(there, back, 1e-9 * there);
            }
        }
        EXPECT_LT(albedo, 1);
        EXPECT_GT(albedo, 0.45);
    }
}

TEST(DielectricBrdf, HeadOnHasTheSpecifiedValue) {
    // D = 1 / (pi alpha^2), masking 1, F = 0.04: 0.96 base / pi + 0.04 / (4 pi alpha^2).
    const glm::dvec3 z(0, 0, 1);
    const double alpha = 0.45 * 0.45;
    const double expected = 0.96 * 0.3 / std::numbers::pi + 0.04 / (4 * std::numbers::pi * alpha * alpha);
    EXPECT_NEAR(dielectricBrdfCosine(glm::dvec3(0.3), 0.45, z, z, z).x, expected, 1e-12);
    EXPECT_NEAR(shadeDielectric(glm::dvec3(0.3), 0.45, z, z, -z, 2.0, 0.5).x, 0.15, 1e-15);
}

TEST(Srgb, GoesThereAndBack) {
    EXPECT_NEAR(srgbFromLinear(0.0031308), 0.0404499, 1e-6);
    EXPECT_NEAR(srgbFromLinear(0.5), 0.735357, 1e-6);
    for (int i = 0; i <= 1000; ++i) EXPECT_NEAR(linearFromSrgb(srgbFromLinear(i / 1000.0)), i / 1000.0, 1e-7);
    EXPECT_EQ(srgbFromLinear(-1), 0);
    EXPECT_NEAR(srgbFromLinear(2), 1, 1e-15);
}

TEST(CameraRays, GoThroughTheirPixels) {
    std::mt19937_64 random(10);
    for (int i = 0; i < 200; ++i) {
        model::Camera camera;
        camera.target_mm = 10.0 * unitVector(random);
        camera.eye_mm = camera.target_mm + std::pow(10.0, uniform(random, 0, 6)) * unitVector(random);
        camera.up = unitVector(random);
        camera.perspective = i % 2 == 0;
        camera.field_of_view_deg = uniform(random, 0.001, 120);
        const double x = uniform(random, 0, 640), y = uniform(random, 0, 480), distance = uniform(random, 1, 1000);
        const Ray ray = cameraRay(camera, 640, 480, x, y);
        EXPECT_NEAR(glm::length(ray.direction), 1, 1e-14);
        const glm::dvec3 seen = projectPoint(camera, 640, 480, ray.origin + distance * ray.direction);
        EXPECT_NEAR(seen.x, x, 2e-3);  // a thousandth of a degree at 1e6 mm
        EXPECT_NEAR(seen.y, y, 2e-3);
    }
}

TEST(CameraRays, KnowUpFromDownAndLeftFromRight) {
    model::Camera camera;
    camera.eye_mm = {0, 0, 100};
    camera.target_mm = {0, 0, 0};
    camera.up = {0, 1, 0};
    camera.height_mm = 20;
    const Ray corner = cameraRay(camera, 40, 20, 0.5, 0.5);  // first pixel: top left
    EXPECT_LT(glm::length(corner.origin - glm::dvec3(-19.5, 9.5, 100)), 1e-12);
    EXPECT_LT(glm::length(corner.direction - glm::dvec3(0, 0, -1)), 1e-15);
    camera.perspective = true;
    camera.field_of_view_deg = 90;
    const Ray top = cameraRay(camera, 40, 20, 20, 0);
    EXPECT_LT(glm::length(top.direction - glm::normalize(glm::dvec3(0, 1, -1))), 1e-14);
}

}  // namespace
}  // namespace radiata::reference
