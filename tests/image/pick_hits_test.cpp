// All hits of picks, as users get them, against the exhaustive search in double along the camera's own ray: the same crossings
// in the same order, of the same lobes and sides, each within 1e-4 mm of its surface (measured along the normal; glyphs have
// radii of about 2 mm); rays whose answer changes when they move by 1e-5 radii, and close pairs, may differ in number.
#include <cmath>
#include <iostream>
#include <random>

#include "image/fixture.h"
#include "reference/camera_rays.h"
#include "reference/glyph_hits.h"

namespace radiata::test {
namespace {

using model::Intersection;

constexpr double kScale = 2;         // mm per unit of amplitude
constexpr double kSurfaceMm = 1e-4;  // as for first hits
constexpr double kPairRadii = 2e-4;  // as pick.proto says
constexpr double kEyeMm = 1e-3;      // of distances of some hundred mm

struct Tally {
    int picks = 0, grazing = 0, wrong = 0, negative = 0;
    std::size_t most = 0;
    double worst = 0;
};

class PickHits : public ImageTest {
protected:
    std::optional<model::PickedGlyph> pickAll(const model::FrameRequest& request, int x, int y) {
        const std::optional<model::Picked> picked = renderer.pick(request, x, y, 0, true);
        if (!picked) return std::nullopt;
        return std::get<model::PickedGlyph>(*picked);
    }

    /// \param allowed  how far off the surface, mm
    void compare(const model::FrameRequest& request, int x, int y, const model::PickedGlyph& glyph, double allowed,
                 Tally& tally) {
        const bool both = request.scene.layers[0].glyphs().negative_lobes == model::NegativeLobes::kShown;
        const reference::ShFunction f(glyph.layout, std::span<const float>(glyph.coefficients));
        const reference::Ray ray = reference::cameraRay(request.camera, request.width, request.height, x + 0.5, y + 0.5);
        const auto expected = reference::glyphHits(f, (ray.origin - glyph.centre_mm) / kScale, ray.direction, both, 0);
        double radius = 0;
        for (const auto& hit : expected.hits) radius = std::max(radius, kScale * std::abs(hit.amplitude));
        ++tally.picks;
        tally.grazing += expected.grazing;
        tally.most = std::max(tally.most, glyph.hits.size());
        std::size_t i = 0, j = 0;
        bool right = true, inside = false;
        for (const model::RayHit& hit : glyph.hits) {
            // Entries and exits alternate, from outside; the fields agree with each other.
            right = right && hit.leaving == inside;
            inside = !inside;
            const glm::dvec3 offset = hit.position_mm - glyph.centre_mm;
            right = right && std::abs(glm::length(offset) - hit.radius_mm) < 1e-9 &&
                    glm::length(offset - hit.radius_mm * hit.direction) < 1e-9 &&
                    std::abs(glm::dot(hit.position_mm - ray.origin, ray.direction) - hit.distance_mm) < kEyeMm &&
                    (!hit.negative_lobe || both);
            tally.negative += hit.negative_lobe;
        }
        while (right && (i < expected.hits.size() || j < glyph.hits.size())) {
            if (i < expected.hits.size() && j < glyph.hits.size() &&
                (expected.hits[i].amplitude < 0) == glyph.hits[j].negative_lobe) {
                const double facing = std::abs(glm::dot(expected.hits[i].normal, ray.direction));
                const double apart = std::abs(kScale * expected.hits[i].t - glyph.hits[j].distance_mm) * facing;
                if (apart < allowed) {
                    tally.worst = std::max(tally.worst, apart);
                    ++i, ++j;
                    continue;
                }
            }
            const auto close = [&](double a, double b) { return b - a < (expected.grazing ? 15 : 1) * kPairRadii * radius; };
            if (i + 1 < expected.hits.size() && close(kScale * expected.hits[i].t, kScale * expected.hits[i + 1].t)) {
                i += 2;
            } else if (j + 1 < glyph.hits.size() && close(glyph.hits[j].distance_mm, glyph.hits[j + 1].distance_mm)) {
                j += 2;
            } else {
                right = false;
            }
        }
        tally.wrong += !right;
        if (right || tally.wrong > 3) return;
        std::cout << "pixel " << x << ", " << y << (expected.grazing ? ", grazing\n" : "\n");
        for (const auto& hit : expected.hits) std::cout << "  expected " << kScale * hit.t << " of " << hit.amplitude << "\n";
        for (const auto& hit : glyph.hits)
            std::cout << "  found " << hit.distance_mm << (hit.negative_lobe ? " -" : " +")
                      << (hit.leaving ? " out\n" : " in\n");
    }

    /// Every pixel of a small picture that shows a glyph.
    Tally comparePicture(const model::FrameRequest& request, double allowed) {
        Tally tally;
        for (int y = 0; y < request.height; ++y) {
            for (int x = 0; x < request.width; ++x) {
                const auto glyph = pickAll(request, x, y);
                if (!glyph) continue;
                EXPECT_FALSE(glyph->hits.empty());
                if (glyph->hits.empty()) continue;
                // The first is what the picture shows.
                EXPECT_LT(glm::length(glyph->hits[0].position_mm - glyph->position_mm), 20 * allowed);
                compare(request, x, y, *glyph, allowed, tally);
            }
        }
        std::cout << model::methodName(request.quality.intersection) << ": " << tally.picks << " picks, " << tally.grazing
                  << " grazing, up to " << tally.most << " hits, " << tally.negative << " of negative lobes, worst "
                  << tally.worst << " mm, " << tally.wrong << " wrong\n";
        return tally;
    }
};

/// Even and full bands, positive lobes and both, in perspective and orthographic, a band limit, by the march.
TEST_F(PickHits, OfAPictureAreThoseOfTheReference) {
    for (const ShLayout layout : {ShLayout{4, false}, ShLayout{12, false}, ShLayout{6, true}}) {
        const std::string id = "l" + std::to_string(layout.lmax);
        const model::ShImage image = randomField(layout, {2, 2, 2}, 91, obliqueAffine());
        store.add(id, image);
        model::FrameRequest request = requestOf(id, 14, 10, kScale);
        for (const bool both : {false, true}) {
            request.scene.layers[0].glyphs().negative_lobes =
                both ? model::NegativeLobes::kShown : model::NegativeLobes::kHidden;
            request.camera = cameraAround(image, {1, 2, 3}, both);
            request.quality.intersection = both ? Intersection::kMarch : Intersection::kPoleTable;
            if (layout.full && both) request.scene.layers[0].glyphs().lmax = 5;
            const Tally tally = comparePicture(request, kSurfaceMm);
            EXPECT_GT(tally.picks, 60);
            EXPECT_EQ(tally.wrong, 0);
            EXPECT_GT(tally.most, 3U);
            EXPECT_EQ(tally.negative > 0, both);
        }
    }
}

/// All real roots of the methods by polynomials, at their own exactness.
TEST_F(PickHits, ByPolynomialsAreTheirRoots) {
    const model::ShImage image = randomField({4, false}, {2, 2, 2}, 92, obliqueAffine());
    store.add("even", image);
    model::FrameRequest request = requestOf("even", 14, 10, kScale);
    request.camera = cameraAround(image, {1, 2, 3}, true);
    for (const Intersection method : {Intersection::kPolynomial, Intersection::kPolynomialDouble, Intersection::kLaguerre}) {
        request.quality.intersection = method;
        for (const bool both : {false, true}) {
            request.scene.layers[0].glyphs().negative_lobes =
                both ? model::NegativeLobes::kShown : model::NegativeLobes::kHidden;
            const Tally tally = comparePicture(request, method == Intersection::kPolynomialDouble ? kSurfaceMm : 2e-3);
            EXPECT_GT(tally.picks, 60);
            EXPECT_LE(tally.wrong, method == Intersection::kPolynomialDouble ? 0 : 2);
        }
    }
    // Odd bands are two polynomials, whose hits are merged.
    model::ShImage odd = randomField({6, true}, {2, 2, 2}, 93, obliqueAffine());
    for (std::size_t g = 0; g < odd.voxels.size(); ++g) {
        for (int l = 0; l <= 6; l += 2) {
            for (int m = -l; m <= l; ++m) odd.coefficients[g * odd.layout.count() + odd.layout.index(l, m)] = 0;
        }
        odd.coefficients[g * odd.layout.count() + odd.layout.index(1, 0)] += 1;
    }
    store.add("odd", odd);
    request.scene.layers[0].glyphs().dataset_id = "odd";
    request.quality.intersection = Intersection::kPolynomial;
    const Tally tally = comparePicture(request, 2e-3);
    EXPECT_GT(tally.picks, 40);
    EXPECT_GT(tally.negative, 10);
    EXPECT_LE(tally.wrong, 2);
}

/// Peters et al. 2023, Fig. 2: band 4 allows ten hits on one ray, by each method that finds all.
TEST_F(PickHits, FindTheTenOfPeters2023Figure2) {
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> unit(-1, 1);
    const ShLayout layout{4, false};
    for (int attempt = 0;; ++attempt) {
        ASSERT_LT(attempt, 20'000);
        std::vector<float> c(layout.count());
        for (float& value : c) value = static_cast<float>(unit(random));
        c[0] *= 0.3F;
        const glm::dvec3 d = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
        const glm::dvec3 aside = glm::normalize(glm::cross(d, glm::dvec3(unit(random), unit(random), 2)));
        const glm::dvec3 foot = aside * (0.1 + 0.09 * unit(random));
        const reference::ShFunction f(layout, c);
        const auto expected = reference::glyphHits(f, foot - 5.0 * d, d, true);
        if (expected.hits.size() != 10 || expected.grazing) continue;
        double apart = 1;
        for (std::size_t i = 1; i < 10; ++i) apart = std::min(apart, expected.hits[i].t - expected.hits[i - 1].t);
        if (apart < 0.01) continue;
        model::ShImage image;
        image.size = glm::ivec3(1);
        image.layout = layout;
        image.voxels = {glm::ivec3(0)};
        image.coefficients = c;
        store.add("ten", image);
        model::FrameRequest request = requestOf("ten", 3, 3, kScale);
        request.scene.layers[0].glyphs().negative_lobes = model::NegativeLobes::kShown;
        request.camera.target_mm = kScale * foot;
        request.camera.eye_mm = kScale * (foot - 50.0 * d);
        request.camera.up = aside;
        request.camera.height_mm = 1;
        for (const Intersection method : {Intersection::kMarch, Intersection::kPolynomial, Intersection::kPolynomialDouble}) {
            request.quality.intersection = method;
            const auto glyph = pickAll(request, 1, 1);
            ASSERT_TRUE(glyph);
            ASSERT_EQ(glyph->hits.size(), 10U) << model::methodName(method);
            Tally tally;
            compare(request, 1, 1, *glyph, 5e-4, tally);
            EXPECT_EQ(tally.wrong, 0) << model::methodName(method);
            for (std::size_t i = 0; i < 10; ++i) {
                EXPECT_NEAR(glyph->hits[i].distance_mm, kScale * (45 + expected.hits[i].t), 2e-3) << i;
            }
        }
        return;
    }
}

TEST_F(PickHits, EndAtClipPlanesAndAreNoneUnlessAskedFor) {
    model::ShImage sphere = randomField({2, false}, {1, 1, 1}, 94, glm::dmat4(1));
    std::fill(sphere.coefficients.begin() + 1, sphere.coefficients.end(), 0.0F);
    sphere.coefficients[0] = 3.5449077F;  // amplitude 1
    store.add("sphere", sphere);
    model::FrameRequest request = requestOf("sphere", 3, 3, kScale);
    request.camera = cameraAround(sphere, {0, 0, 1}, false);
    const auto eye = glm::length(request.camera.eye_mm - voxelCentre(sphere, {0, 0, 0}));
    auto glyph = pickAll(request, 1, 1);
    ASSERT_TRUE(glyph);
    ASSERT_EQ(glyph->hits.size(), 2U);
    EXPECT_NEAR(glyph->hits[0].distance_mm, eye - 2, 1e-4);
    EXPECT_NEAR(glyph->hits[1].distance_mm, eye + 2, 1e-4);
    EXPECT_FALSE(glyph->hits[0].leaving);
    EXPECT_TRUE(glyph->hits[1].leaving);
    // From within the glyph the ray only leaves.
    request.camera.clip = model::Clip{eye, eye + 100};
    glyph = pickAll(request, 1, 1);
    ASSERT_TRUE(glyph);
    ASSERT_EQ(glyph->hits.size(), 1U);
    EXPECT_TRUE(glyph->hits[0].leaving);
    request.camera.clip = model::Clip{0, eye + 1};
    glyph = pickAll(request, 1, 1);
    ASSERT_TRUE(glyph);
    EXPECT_EQ(glyph->hits.size(), 1U);
    const auto plain = renderer.pick(request, 1, 1);
    ASSERT_TRUE(plain);
    EXPECT_TRUE(std::get<model::PickedGlyph>(*plain).hits.empty());
}

TEST_F(PickHits, OfMethodsAndGlyphsWithoutThemAreRefused) {
    const model::ShImage image = randomField({4, false}, {2, 2, 2}, 95, obliqueAffine());
    store.add("field", image);
    store.add("full", randomField({4, true}, {2, 2, 2}, 96, obliqueAffine()));
    model::FrameRequest request = requestOf("field", 9, 9, kScale);
    request.camera = cameraAround(image, {1, 2, 3}, true);
    for (const Intersection method :
         {Intersection::kRayMarchPeeters, Intersection::kRayMarchVanAlmsick, Intersection::kTensorMarch,
          Intersection::kTensorInterval, Intersection::kTensorAffine, Intersection::kTessellated}) {
        request.quality.intersection = method;
        EXPECT_EQ(codeOf([&] { renderer.pick(request, 4, 4, 0, true); }), Code::kInvalidArgument) << model::methodName(method);
    }
    // Even and odd bands together are not for polynomials.
    request.quality.intersection = Intersection::kPolynomial;
    request.scene.layers[0].glyphs().dataset_id = "full";
    EXPECT_EQ(codeOf([&] { renderer.pick(request, 4, 4, 0, true); }), Code::kUnsupported);
}

}  // namespace
}  // namespace radiata::test
