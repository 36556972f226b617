// A small picture by every method of intersection against the march: wrong is a pixel that shows another glyph, or a point
// farther from the march's surface along its normal than the method's stated error.
#include <cstdio>

#include "image/fixture.h"

namespace radiata::test {
namespace {

using model::Intersection;

class Methods : public ImageTest {
protected:
    explicit Methods(const gpu::DeviceOptions& options = {}) : ImageTest(options) {}

    model::FrameRequest fieldRequest(const std::string& id, const model::ShImage& image) {
        store.add(id, image);
        model::FrameRequest request = requestOf(id, 120, 90, 2);
        request.camera = cameraAround(image, {1, 2, 2}, true);
        request.scene.layers[0].glyphs().negative_lobes = model::NegativeLobes::kShown;
        request.quality.samples = 1;
        return request;
    }

    double radiusMm(const std::string& id) { return 2 * double{store.info(id).amplitude_max}; }

    /// \param error  mm
    static int wrongPixels(const model::Frame& march, const model::Frame& frame, double error) {
        int wrong = 0;
        for (std::size_t i = 0; i < march.pixels.depth.size(); ++i) {
            bool same = true;
            for (std::size_t c = 0; c < 4; ++c) same = same && march.pixels.id[4 * i + c] == frame.pixels.id[4 * i + c];
            if (same && march.pixels.id[4 * i] >= 0) {
                const auto at = [i](const std::vector<float>& v) { return glm::dvec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]); };
                const glm::dvec3 apart = march.info.position_origin_mm + at(march.pixels.position) -
                                         frame.info.position_origin_mm - at(frame.pixels.position);
                same = std::abs(glm::dot(apart, at(march.pixels.normal))) <= error;
            }
            wrong += !same;
        }
        return wrong;
    }

    static int hitPixels(const model::Frame& frame) {
        int hits = 0;
        for (std::size_t i = 0; i < frame.pixels.depth.size(); ++i) hits += frame.pixels.id[4 * i] >= 0;
        return hits;
    }
};

struct Case {
    Intersection method;
    int lmax;
    int steps;               ///< of marches with equal steps
    double error_radii;      ///< stated, of a hit
    double wrong_share_max;  ///< of the pixels that show something
};

/// Marches with equal steps lose what is thinner than a step: at silhouettes and where lobes meet.
TEST_F(Methods, AgreeWithTheMarchWithinTheirStatedErrors) {
    const Case cases[] = {
        {Intersection::kPolynomial, 4, 0, 2e-5, 1e-3},           {Intersection::kPolynomial, 8, 0, 2e-5, 1e-3},
        {Intersection::kPolynomialDouble, 4, 0, 1e-5, 1e-3},     {Intersection::kLaguerre, 4, 0, 1e-4, 1e-3},
        {Intersection::kRayMarchPeeters, 4, 200, 2e-5, 1e-3},    {Intersection::kRayMarchPeeters, 8, 200, 2e-5, 1e-3},
        {Intersection::kRayMarchVanAlmsick, 4, 200, 1e-4, 1e-3}, {Intersection::kRayMarchVanAlmsick, 8, 200, 5e-4, 1e-3},
    };
    for (const int lmax : {4, 8}) {
        const std::string id = "field" + std::to_string(lmax);
        model::FrameRequest request = fieldRequest(id, randomField({lmax, false}, {3, 3, 2}, 4, obliqueAffine()));
        const model::Frame march = draw(request);
        const int hits = hitPixels(march);
        ASSERT_GT(hits, 2000);
        for (const Case& c : cases) {
            if (c.lmax != lmax) continue;
            request.quality.intersection = c.method;
            request.quality.ray_march.steps = std::max(c.steps, 1);
            for (const model::PoleTable table : {model::PoleTable::kOff, model::PoleTable::kOn}) {
                request.quality.pole_table = table;
                const model::Frame frame = draw(request);
                const int wrong = wrongPixels(march, frame, c.error_radii * radiusMm(id));
                std::printf("%s, lmax %d, table %s: %d of %d pixels wrong\n", std::string(model::methodName(c.method)).c_str(),
                            lmax, frame.info.pole_table_used ? "used" : "not used", wrong, hits);
                EXPECT_LE(wrong, c.wrong_share_max * hits) << model::methodName(c.method);
                EXPECT_EQ(frame.info.request.quality.intersection, c.method);
                if (c.method != Intersection::kRayMarchVanAlmsick) break;
            }
        }
    }
}

TEST_F(Methods, PolynomialDrawsOddBandsAlone) {
    model::ShImage image = randomField({5, true}, {3, 3, 2}, 5, obliqueAffine());
    for (std::size_t at = 0; at < image.coefficients.size(); ++at) {
        const std::size_t index = at % image.layout.count();
        int l = 0;
        while (std::size_t((l + 1) * (l + 1)) <= index) ++l;
        image.coefficients[at] = l % 2 == 0 ? 0 : 3 * image.coefficients[at];
    }
    model::FrameRequest request = fieldRequest("odd", image);
    const model::Frame march = draw(request);
    request.quality.intersection = Intersection::kPolynomial;
    const model::Frame polynomial = draw(request);
    const int wrong = wrongPixels(march, polynomial, 2e-5 * radiusMm("odd"));
    std::printf("odd bands: %d of %d pixels wrong\n", wrong, hitPixels(march));
    EXPECT_GT(hitPixels(march), 1000);
    EXPECT_LE(wrong, 3);
    store.add("both", randomField({5, true}, {2, 1, 1}, 6, obliqueAffine()));
    request.scene.layers[0].glyphs().dataset_id = "both";
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kUnsupported);
}

TEST_F(Methods, VanAlmsickRotatesOncePerCameraOrForEachRay) {
    model::FrameRequest request = fieldRequest("field", randomField({4, false}, {3, 3, 2}, 7, obliqueAffine()));
    request.quality.intersection = Intersection::kRayMarchVanAlmsick;
    request.quality.pole_table = model::PoleTable::kOff;
    const model::Frame per_ray = draw(request);
    EXPECT_EQ(per_ray.info.passes.at(0).shader.find("glyph_ray_march_"), 0U);
    request.quality.pole_table = model::PoleTable::kOn;
    const model::Frame once = draw(request);
    EXPECT_EQ(once.info.passes.at(0).shader, "glyph_van_almsick_table_even4");
    EXPECT_TRUE(once.info.pole_table_used);
}

TEST_F(Methods, PoleTableIsTheMarchWithItsTable) {
    model::FrameRequest request = fieldRequest("field", randomField({4, false}, {3, 3, 2}, 8, obliqueAffine()));
    request.quality.pole_table = model::PoleTable::kOn;
    const model::Frame march = draw(request);
    request.quality.intersection = Intersection::kPoleTable;
    request.quality.pole_table = model::PoleTable::kAuto;
    const model::Frame named = draw(request);
    EXPECT_EQ(named.pixels.rgba, march.pixels.rgba);
    EXPECT_TRUE(named.info.pole_table_used);
    EXPECT_EQ(named.info.request.quality.intersection, Intersection::kPoleTable);
    request.quality.pole_table = model::PoleTable::kOff;
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
}

/// Looser boxes: more are visited, and the picture is the same.
TEST_F(Methods, DrawTheSameThroughBoxesAroundCylinders) {
    model::FrameRequest request = fieldRequest("field", randomField({4, false}, {3, 3, 2}, 9, obliqueAffine()));
    for (const Intersection method : {Intersection::kMarch, Intersection::kPolynomial}) {
        request.quality.intersection = method;
        for (const model::Traversal traversal : {model::Traversal::kTiles, model::Traversal::kBvh}) {
            request.quality.traversal = traversal;
            request.quality.glyph_boxes = model::GlyphBoxes::kTight;
            const model::Frame tight = draw(request);
            request.quality.glyph_boxes = model::GlyphBoxes::kCylinder;
            const model::Frame loose = draw(request);
            EXPECT_EQ(wrongPixels(tight, loose, 1e-6 * radiusMm("field")), 0);
            long tight_steps = 0, loose_steps = 0;
            for (const std::int32_t steps : tight.pixels.steps) tight_steps += steps;
            for (const std::int32_t steps : loose.pixels.steps) loose_steps += steps;
            EXPECT_GE(loose_steps, tight_steps);
        }
    }
}

class MethodsWithoutDoubles : public Methods {
protected:
    MethodsWithoutDoubles()
        : Methods({.device = {}, .validation = false, .pipeline_cache = {}, .without = {"shader_float64"}}) {}
};

TEST_F(MethodsWithoutDoubles, RefusePolynomialDouble) {
    model::FrameRequest request = fieldRequest("field", randomField({4, false}, {2, 1, 1}, 10, obliqueAffine()));
    request.quality.intersection = Intersection::kPolynomialDouble;
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kUnsupported);
    request.quality.intersection = Intersection::kPolynomial;
    EXPECT_GT(hitPixels(draw(request)), 0);
}

}  // namespace
}  // namespace radiata::test
