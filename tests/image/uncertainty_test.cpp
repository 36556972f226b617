// Pictures with uncertainty against the double reference; what is off costs nothing; what does not fit is refused.
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "build/isotropic_part.h"
#include "build/uncertain_glyphs.h"
#include "image/fixture.h"
#include "reference/camera_rays.h"
#include "reference/inside_length.h"
#include "reference/shading.h"

namespace radiata::test {
namespace {

const glm::vec3 kEmission(0.5F, 0.1F, 0.2F);
constexpr float kExtinction = 0.8F;

std::vector<std::uint32_t> allSlots(const model::ShImage& image) {
    std::vector<std::uint32_t> slots(image.voxels.size());
    std::iota(slots.begin(), slots.end(), 0U);
    return slots;
}

class UncertaintyPicture : public ImageTest {
protected:
    /// A field, and second glyphs twice as large, which overlap their neighbours.
    void addField(ShLayout layout, const glm::ivec3& size) {
        mean = randomField(layout, size, 71, obliqueAffine());
        mean.source = "field";
        outer = uncertaintyByRecipe(mean, {4.5, 0.2, 5});
        outer.source = "outer";
        store.add("field", mean);
        store.add("outer", outer);
    }

    model::FrameRequest plainRequest(float mm_per_amplitude) const {
        model::FrameRequest request = requestOf("field", 72, 54, mm_per_amplitude);
        request.camera = cameraAround(mean, {1, 2, 3}, true);
        request.scene.light.irradiance = 0.6F;  // nothing is clipped
        request.scene.background = glm::vec3(0.05F, 0.3F, 0.1F);
        request.scene.annotations.hidden = true;
        return request;
    }

    static model::FrameRequest uncertain(model::FrameRequest request) {
        model::Uncertainty uncertainty;
        uncertainty.dataset_id = "outer";
        uncertainty.extinction_per_mm = kExtinction;
        uncertainty.emission = kEmission;
        request.scene.layers[0].glyphs().uncertainty = uncertainty;
        return request;
    }

    struct Check {
        int pixels = 0, with_medium = 0, overlapping = 0, cut = 0;
        double worst = 0;  ///< 8-bit steps of sRGB
    };

    /// Each pixel must be what the plain picture has there, through the medium up to the plain picture's depth.
    Check compare(const model::FrameRequest& request) {
        const model::Frame plain = draw(request), seen = draw(uncertain(request));
        EXPECT_EQ(seen.pixels.depth, plain.pixels.depth) << "outputs are those of the opaque glyphs";
        EXPECT_EQ(seen.pixels.id, plain.pixels.id);
        EXPECT_EQ(seen.info.capped_rays, 0U);
        std::vector<reference::ShFunction> functions;
        const std::size_t stride = outer.layout.count();
        for (std::size_t v = 0; v < outer.voxels.size(); ++v) {
            functions.emplace_back(outer.layout, std::span(outer.coefficients).subspan(v * stride, stride));
        }
        const glm::dvec3 forward = model::cameraFrame(request.camera).forward;
        const double scale = static_cast<double>(request.scene.layers[0].glyphs().scale.factor);
        const bool both = request.scene.layers[0].glyphs().negative_lobes == model::NegativeLobes::kShown;
        Check check;
        for (int y = 1; y < request.height; y += 3) {
            for (int x = 1; x < request.width; x += 3) {
                const std::size_t at = static_cast<std::size_t>(y * request.width + x);
                const reference::Ray ray =
                    reference::cameraRay(request.camera, request.width, request.height, x + 0.5, y + 0.5);
                double end = 1e3;
                if (std::isfinite(plain.pixels.depth[at])) {
                    end = (static_cast<double>(plain.pixels.depth[at]) + plain.info.depth_offset_mm) /
                          glm::dot(ray.direction, forward);
                }
                double length = 0;
                int glyphs = 0;
                for (std::size_t v = 0; v < functions.size(); ++v) {
                    const glm::dvec3 origin = (ray.origin - voxelCentre(outer, outer.voxels[v])) / scale;
                    const double begin = request.camera.perspective ? 0 : -1e3 / scale;
                    const double part =
                        scale * reference::insideLength(functions[v], origin, ray.direction, begin, end / scale, both);
                    length += part;
                    glyphs += part > 0;
                    if (part > 0 && end < 1e3) {
                        check.cut += reference::insideGlyph(functions[v], origin + (end / scale) * ray.direction, both);
                    }
                }
                const double transmittance = std::exp(-static_cast<double>(kExtinction) * length);
                for (std::size_t c = 0; c < 3; ++c) {
                    const double behind = reference::linearFromSrgb(plain.pixels.rgba[4 * at + c] / 255.0);
                    const double emission = static_cast<double>(kEmission[static_cast<int>(c)]);
                    const double expected =
                        255 * reference::srgbFromLinear(behind * transmittance + emission * (1 - transmittance));
                    check.worst = std::max(check.worst, std::abs(expected - seen.pixels.rgba[4 * at + c]));
                }
                ++check.pixels;
                check.with_medium += glyphs > 0;
                check.overlapping += glyphs > 1;
            }
        }
        std::printf("%d pixels, %d through media, %d through several, %d surfaces inside of one; worst %.2f steps of 255\n",
                    check.pixels, check.with_medium, check.overlapping, check.cut, check.worst);
        return check;
    }

    model::ShImage mean, outer;
};

/// Rounding of both pictures: half a step of the plain one, which the transfer curve may stretch where the medium darkens, and
/// half a step of the other.
constexpr double kBound = 1.7;

TEST_F(UncertaintyPicture, IsTheMediumUpToTheFirstOpaqueHit) {
    addField({4, false}, {3, 3, 2});
    for (const bool both : {false, true}) {
        model::FrameRequest request = plainRequest(0.75F);
        if (both) request.scene.layers[0].glyphs().negative_lobes = model::NegativeLobes::kShown;
        const Check check = compare(request);
        EXPECT_LE(check.worst, kBound);
        EXPECT_GT(check.with_medium, 150);
        EXPECT_GT(check.overlapping, 50);
        EXPECT_GT(check.cut, 50);
    }
}

TEST_F(UncertaintyPicture, IsRightWithOddBandsTablesAndAnOrthographicCamera) {
    addField({3, true}, {3, 2, 2});
    model::FrameRequest request = plainRequest(0.75F);
    request.quality.pole_table = model::PoleTable::kOn;
    request.camera.perspective = false;
    const Check check = compare(request);
    EXPECT_LE(check.worst, kBound);
    EXPECT_GT(check.overlapping, 20);
}

TEST_F(UncertaintyPicture, IsRightFromInsideOfASecondGlyph) {
    addField({4, false}, {3, 3, 2});
    model::FrameRequest request = plainRequest(0.9F);
    // Between the outer surface of the middle glyph and the glyph itself.
    const std::size_t middle = 4;
    const std::size_t stride = mean.layout.count();
    const reference::ShFunction f(mean.layout, std::span(mean.coefficients).subspan(middle * stride, stride));
    const reference::ShFunction g(mean.layout, std::span(outer.coefficients).subspan(middle * stride, stride));
    glm::dvec3 direction(0);
    double gap = 0;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 d = glm::normalize(glm::dvec3(std::cos(2.4 * i), std::sin(2.4 * i), (i - 100) / 60.0));
        if (g(d) - std::max(f(d), 0.0) > gap) {
            gap = g(d) - std::max(f(d), 0.0);
            direction = d;
        }
    }
    ASSERT_GT(gap, 0.3);
    const glm::dvec3 centre = voxelCentre(mean, mean.voxels[middle]);
    request.camera.eye_mm = centre + 0.9 * (std::max(f(direction), 0.0) + 0.6 * gap) * direction;
    request.camera.target_mm = centre + glm::dvec3(0.1, 0.2, 0.05);
    request.camera.up = std::abs(direction.z) > 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    request.camera.field_of_view_deg = 70;
    const Check check = compare(request);
    EXPECT_LE(check.worst, kBound);
    EXPECT_EQ(check.with_medium, check.pixels);
}

TEST_F(UncertaintyPicture, IsTheSameByEveryWayToTheBoxes) {
    addField({4, false}, {4, 3, 2});
    model::FrameRequest request = uncertain(plainRequest(0.8F));
    request.quality.samples = 2;
    request.quality.traversal = model::Traversal::kTiles;
    const model::Frame first = draw(request);
    for (const model::Traversal traversal : {model::Traversal::kBvh, model::Traversal::kRayQuery}) {
        for (const model::PoleTable table : {model::PoleTable::kOff, model::PoleTable::kOn}) {
            request.quality.traversal = traversal;
            request.quality.pole_table = table;
            const model::Frame frame = draw(request);
            int worst = 0;
            for (std::size_t i = 0; i < frame.pixels.rgba.size(); ++i) {
                worst = std::max(worst, std::abs(int{frame.pixels.rgba[i]} - int{first.pixels.rgba[i]}));
            }
            // Lengths are added in another order; at silhouettes tables round otherwise.
            EXPECT_LE(worst, 2);
        }
    }
}

TEST_F(UncertaintyPicture, FromDeviationsIsThatOfTheOuterGlyphs) {
    addField({4, false}, {3, 2, 2});
    model::ShImage deviations = mean;
    deviations.source = "deviations";
    deviations.file_convention = ShConvention::kDescoteaux07;
    for (float& value : deviations.coefficients) value = 0.2F * std::abs(value);
    store.add("made", outerGlyphs(mean, allSlots(mean), deviations, 1.5, 4));
    store.add("deviations", deviations);
    model::FrameRequest request = uncertain(plainRequest(0.8F));
    model::Uncertainty& uncertainty = *request.scene.layers[0].glyphs().uncertainty;
    uncertainty.dataset_id = "made";
    const model::Frame made = draw(request);
    uncertainty.dataset_id = "deviations";
    uncertainty.kind = model::UncertaintyKind::kDeviations;
    uncertainty.deviations = 1.5F;
    EXPECT_EQ(draw(request).pixels.rgba, made.pixels.rgba);
    uncertainty.deviations = 3;
    EXPECT_NE(draw(request).pixels.rgba, made.pixels.rgba);
}

TEST_F(UncertaintyPicture, FillsInTheExtinctionAndReplaysToTheSameBytes) {
    addField({4, false}, {3, 2, 2});
    model::FrameRequest request = uncertain(plainRequest(0.8F));
    request.scene.layers[0].glyphs().uncertainty->extinction_per_mm.reset();
    const model::Frame first = draw(request);
    ASSERT_TRUE(first.info.request.scene.layers[0].glyphs().uncertainty->extinction_per_mm);
    // The shortest voxel edge of the oblique grid is 1 mm.
    EXPECT_NEAR(*first.info.request.scene.layers[0].glyphs().uncertainty->extinction_per_mm, 4, 1e-5);
    EXPECT_EQ(draw(first.info.request).pixels.rgba, first.pixels.rgba);
}

TEST_F(UncertaintyPicture, MixesSeveralLayers) {
    addField({2, false}, {2, 2, 1});
    // The same medium twice is the medium of twice the extinction.
    model::FrameRequest once = uncertain(plainRequest(0.8F)), twice = once;
    once.scene.layers[0].glyphs().uncertainty->extinction_per_mm = 2 * kExtinction;
    twice.scene.layers.push_back(twice.scene.layers[0]);
    const model::Frame a = draw(once), b = draw(twice);
    int worst = 0;
    for (std::size_t i = 0; i < a.pixels.rgba.size(); ++i) {
        worst = std::max(worst, std::abs(int{a.pixels.rgba[i]} - int{b.pixels.rgba[i]}));
    }
    EXPECT_LE(worst, 1);
    EXPECT_NE(a.pixels.rgba, draw(plainRequest(0.8F)).pixels.rgba);
}

TEST_F(UncertaintyPicture, CostsNothingWhereItIsOff) {
    addField({4, false}, {6, 6, 2});
    store.glyphs("field");
    store.glyphs("outer");
    const auto names = [](const model::Frame& frame) {
        std::vector<std::string> result;
        for (const model::PassTime& pass : frame.info.passes) result.push_back(pass.name + " by " + pass.shader);
        return result;
    };
    model::FrameRequest plain = plainRequest(0.8F);
    plain.quality.traversal = model::Traversal::kBvh;
    plain.quality.pole_table = model::PoleTable::kOff;
    const std::uint64_t before = device.allocatedBytes();
    render::Target target;
    const std::size_t none = renderer.pipelineCount();
    const model::Frame frame = renderer.render(target, plain, 0, 1);
    const std::uint64_t plain_bytes = device.allocatedBytes() - before;
    const std::size_t plain_pipelines = renderer.pipelineCount() - none;
    EXPECT_EQ(names(frame), (std::vector<std::string>{"glyph trace by glyph_trace_even4", "light by light"}));
    EXPECT_EQ(plain_pipelines, 2U);
    const model::Frame seen = renderer.render(target, uncertain(plain), 0, 1);
    EXPECT_EQ(names(seen), (std::vector<std::string>{"glyph trace by glyph_trace_even4",
                                                     "uncertainty by glyph_uncertainty_even4", "light by light"}));
    EXPECT_EQ(renderer.pipelineCount() - none, plain_pipelines + 2) << "the pass, and the light pass that reads it";
    EXPECT_GE(device.allocatedBytes() - before, plain_bytes + 72 * 54 * 16);
    // A target that showed uncertainty and no longer does keeps nothing of it; the glyphs stay ready for the next time.
    const std::uint64_t both = device.allocatedBytes();
    renderer.render(target, plain, 0, 1);
    EXPECT_LE(device.allocatedBytes() + 72 * 54 * 16, both);
    render::Target other;
    const std::uint64_t ready = device.allocatedBytes();
    renderer.render(other, plain, 0, 1);
    const std::uint64_t target_bytes = device.allocatedBytes() - ready;
    EXPECT_LE(target_bytes, plain_bytes) << "a target without uncertainty takes what it took before there was any";
}

TEST_F(UncertaintyPicture, RefusesImagesThatDoNotFitAndNumbersOutOfRange) {
    addField({2, false}, {2, 2, 1});
    store.add("smaller", randomField({2, false}, {2, 1, 1}, 3, obliqueAffine()));
    store.add("moved", randomField({2, false}, {2, 2, 1}, 3, glm::dmat4(1.0)));
    const auto refusal = [&](const std::function<void(model::Uncertainty&)>& change) {
        model::FrameRequest request = uncertain(plainRequest(0.8F));
        change(*request.scene.layers[0].glyphs().uncertainty);
        return codeOf([&] { draw(request); });
    };
    EXPECT_EQ(refusal([](auto& u) { u.dataset_id = "smaller"; }), Code::kInvalidArgument);
    EXPECT_EQ(refusal([](auto& u) { u.dataset_id = "moved"; }), Code::kInvalidArgument);
    EXPECT_EQ(refusal([](auto& u) { u.dataset_id = "nobody"; }), Code::kNotFound);
    EXPECT_EQ(refusal([](auto& u) { u.kind = model::UncertaintyKind::kDeviations; }), Code::kInvalidArgument)
        << "random coefficients are negative somewhere";
    for (const float bad : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        EXPECT_EQ(refusal([&](auto& u) { u.extinction_per_mm = bad; }), Code::kInvalidArgument);
        EXPECT_EQ(refusal([&](auto& u) { u.deviations = bad; }), Code::kInvalidArgument);
    }
    EXPECT_EQ(refusal([](auto& u) { u.emission.y = 1.1F; }), Code::kInvalidArgument);
    model::FrameRequest request = plainRequest(0.8F);
    for (const float bad : {-0.1F, 11.0F, std::numeric_limits<float>::quiet_NaN()}) {
        request.scene.layers[0].glyphs().isotropic_part = bad;
        EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
    }
}

TEST_F(UncertaintyPicture, IsotropicPartIsThatOfAnImageWithIt) {
    addField({4, false}, {3, 2, 2});
    const double typical = static_cast<double>(store.info("field").amplitude_typical);
    store.add("rounder", withIsotropicPart(mean, allSlots(mean), 0.25 * typical));
    model::FrameRequest request = plainRequest(0.5F);
    const model::Frame plain = draw(request);
    request.scene.layers[0].glyphs().isotropic_part = 0.25F;
    const model::Frame added = draw(request);
    request.scene.layers[0].glyphs().isotropic_part = 0;
    request.scene.layers[0].glyphs().dataset_id = "rounder";
    const model::Frame made = draw(request);
    EXPECT_EQ(added.pixels.rgba, made.pixels.rgba);
    EXPECT_EQ(added.pixels.id, made.pixels.id);
    EXPECT_GT(added.info.hit_pixels, plain.info.hit_pixels);
}

}  // namespace
}  // namespace radiata::test
