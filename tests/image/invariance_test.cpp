// The same scene described in other words gives the same picture: turned with its camera, scaled with it, moved with it by a
// kilometre, or written in another convention of spherical harmonics and converted. One colour, as direction colours turn with
// the scanner's axes. Bounds: equal bytes where nothing is rounded differently (powers of two, signs and order); else the same
// glyph in all but 0.2 % of the pixels, depth within 2e-5 radii where the surface is not seen at a grazing angle, and colours
// within 2/255 in all but 0.5 %.
#include <cmath>
#include <cstdlib>

#include "image/fixture.h"
#include "math/sh_convention.h"
#include "math/sh_rotation.h"
#include "store/glyph_dataset.h"

namespace radiata::test {
namespace {

constexpr int kWidth = 200, kHeight = 150;

class Invariance : public ImageTest {
protected:
    struct View {
        model::ShImage image;
        model::FrameRequest request;
    };

    static View plain(ShLayout layout, bool perspective) {
        View view{randomField(layout, {3, 2, 2}, 31, glm::dmat4(1.0)), requestOf("", kWidth, kHeight, 0.4F)};
        view.request.scene.annotations.hidden = true;
        view.request.scene.layers[0].glyphs().negative_lobes = model::NegativeLobes::kShown;
        view.request.scene.layers[0].glyphs().colour.mode = model::ColourMode::kUniform;
        view.request.camera = cameraAround(view.image, {0.5, -1, 0.7}, perspective);
        return view;
    }

    model::Frame drawn(const std::string& id, View view) {
        store.add(id, std::move(view.image));
        view.request.scene.layers[0].glyphs().dataset_id = id;
        return draw(view.request);
    }

    double radiusOf(const std::string& id) {
        std::vector<std::uint32_t> first{0};
        const auto dataset = store.glyphs(id);
        return 0.4 * double(dataset->bounds(first, dataset->image().layout.lmax, true)[0].radius);
    }

    /// \param scale  of b's millimetres against a's
    void expectSame(const model::Frame& a, const model::Frame& b, double radius, double scale, const glm::dmat3& turn) {
        int hits = 0, other = 0, colours = 0;
        double worst = 0;
        for (std::size_t i = 0; i < a.pixels.depth.size(); ++i) {
            bool same = true;
            for (std::size_t c = 0; c < 4; ++c) same = same && a.pixels.id[4 * i + c] == b.pixels.id[4 * i + c];
            hits += a.pixels.id[4 * i] >= 0;
            other += !same;
            for (std::size_t c = 0; c < 3; ++c) {
                if (std::abs(int(a.pixels.rgba[4 * i + c]) - int(b.pixels.rgba[4 * i + c])) <= 2) continue;
                ++colours;
                break;
            }
            if (!same || a.pixels.id[4 * i] < 0) continue;
            const glm::dvec3 na(a.pixels.normal[3 * i], a.pixels.normal[3 * i + 1], a.pixels.normal[3 * i + 2]);
            const glm::dvec3 nb(b.pixels.normal[3 * i], b.pixels.normal[3 * i + 1], b.pixels.normal[3 * i + 2]);
            const model::Camera& camera = a.info.request.camera;
            const glm::dvec3 sight = glm::normalize(camera.target_mm - camera.eye_mm);
            if (std::abs(glm::dot(sight, na)) < 0.3) continue;
            const double depth_a = double(a.pixels.depth[i]) + a.info.depth_offset_mm;
            const double depth_b = double(b.pixels.depth[i]) + b.info.depth_offset_mm;
            worst = std::max(worst, std::abs(depth_b / scale - depth_a) / radius);
            EXPECT_LT(glm::length(turn * na - nb), 0.02) << "pixel " << i;
        }
        const double pixels = double(a.pixels.depth.size());
        std::printf("%d hits, %d of another glyph, %d of another colour, depth off by %.2g radii\n", hits, other, colours,
                    worst);
        EXPECT_GT(hits, 2000);
        EXPECT_LE(other, 0.002 * pixels);
        EXPECT_LE(colours, 0.005 * pixels);
        EXPECT_LT(worst, 2e-5);
    }

    static void transform(model::Camera& camera, const glm::dmat4& motion) {
        camera.eye_mm = glm::dvec3(motion * glm::dvec4(camera.eye_mm, 1));
        camera.target_mm = glm::dvec3(motion * glm::dvec4(camera.target_mm, 1));
        camera.up = glm::normalize(glm::dmat3(motion) * camera.up);
    }
};

TEST_F(Invariance, TurnedWithItsCamera) {
    // Two thirds of a radian about an axis of no symmetry.
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.7, 0.5));
    const double c = std::cos(2.0 / 3), s = std::sin(2.0 / 3);
    const glm::dmat3 cross(0, axis.z, -axis.y, -axis.z, 0, axis.x, axis.y, -axis.x, 0);
    const glm::dmat3 turn = c * glm::dmat3(1.0) + s * cross + (1 - c) * glm::outerProduct(axis, axis);
    for (const ShLayout layout : {ShLayout{8, false}, ShLayout{4, true}}) {
        const std::string id = layout.full ? "full" : "even";
        const View view = plain(layout, true);
        View turned = view;
        const ShRotation rotation(layout, turn);
        for (std::size_t v = 0; v < turned.image.voxels.size(); ++v) {
            float* first = turned.image.coefficients.data() + v * layout.count();
            std::vector<double> coefficients(first, first + layout.count());
            rotation.apply(coefficients);
            std::copy(coefficients.begin(), coefficients.end(), first);
        }
        turned.image.voxel_to_world = glm::dmat4(turn) * turned.image.voxel_to_world;
        transform(turned.request.camera, glm::dmat4(turn));
        const model::Frame a = drawn(id, view), b = drawn(id + "-turned", turned);
        expectSame(a, b, radiusOf(id), 1, turn);
    }
}

TEST_F(Invariance, ScaledWithItsCamera) {
    for (const double scale : {1024.0, 1000.0, 1e-3}) {
        const std::string id = "s" + std::to_string(int(scale));
        const View view = plain({8, false}, false);
        View scaled = view;
        scaled.image.voxel_to_world = glm::dmat4(glm::dmat3(scale));
        scaled.image.voxel_to_world[3] = glm::dvec4(scale * glm::dvec3(view.image.voxel_to_world[3]), 1);
        scaled.request.scene.layers[0].glyphs().scale.factor = float(scale * 0.4F);
        scaled.request.camera.eye_mm *= scale;
        scaled.request.camera.target_mm *= scale;
        scaled.request.camera.height_mm *= scale;
        const model::Frame a = drawn(id, view), b = drawn(id + "-scaled", scaled);
        expectSame(a, b, radiusOf(id), scale, glm::dmat3(1.0));
        if (scale == 1024.0) {
            EXPECT_EQ(a.pixels.rgba, b.pixels.rgba);
        }
    }
}

TEST_F(Invariance, MovedWithItsCameraByAKilometre) {
    for (const bool perspective : {false, true}) {
        const std::string id = perspective ? "p" : "o";
        const glm::dvec3 far = 1e6 * glm::normalize(glm::dvec3(1, -2, 0.5));
        const View view = plain({8, false}, perspective);
        View moved = view;
        moved.image.voxel_to_world[3] += glm::dvec4(far, 0);
        moved.request.camera.eye_mm += far;
        moved.request.camera.target_mm += far;
        const model::Frame a = drawn(id, view), b = drawn(id + "-moved", moved);
        expectSame(a, b, radiusOf(id), 1, glm::dmat3(1.0));
    }
}

TEST_F(Invariance, WrittenInAnotherConventionAndConverted) {
    const View view = plain({8, false}, true);
    const model::Frame expected = drawn("own", view);
    for (const ShConvention convention :
         {ShConvention::kDescoteaux07Legacy, ShConvention::kTournier07, ShConvention::kMrtrix02}) {
        View other = view;
        for (std::size_t v = 0; v < other.image.voxels.size(); ++v) {
            const std::span<float> c = std::span(other.image.coefficients).subspan(v * 45, 45);
            const std::vector<float> before(c.begin(), c.end());
            convertSh(c, other.image.layout, ShConvention::kDescoteaux07, convention);
            EXPECT_FALSE(std::equal(c.begin(), c.end(), before.begin()));
            convertSh(c, other.image.layout, convention, ShConvention::kDescoteaux07);
        }
        const std::string id = "convention" + std::to_string(int(convention));
        const model::Frame frame = drawn(id, other);
        expectSame(expected, frame, radiusOf("own"), 1, glm::dmat3(1.0));
        if (convention != ShConvention::kMrtrix02) {
            EXPECT_EQ(expected.pixels.rgba, frame.pixels.rgba);
        }
    }
}

}  // namespace
}  // namespace radiata::test
