// Glyphs drawn as triangles. Boxes with a march per fragment give the traced picture, byte for byte. Deformed spheres come
// closer to it with every level, at the rate of flat triangles on a curved surface.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "image/fixture.h"
#include "store/glyph_dataset.h"

namespace radiata::test {
namespace {

using model::SphereMesh;

class Raster : public ImageTest {
protected:
    Raster() : ImageTest({.validation = true}) {}
    void TearDown() override {
        for (const std::string& message : device.takeValidationMessages()) ADD_FAILURE() << message;
    }

    /// Equal bytes, of normals within 2e-6; not the steps, which only tell how many glyphs were tried.
    static void expectSamePixels(const model::Frame& a, const model::Frame& b) {
        EXPECT_EQ(a.pixels.rgba, b.pixels.rgba);
        EXPECT_EQ(a.pixels.depth, b.pixels.depth);
        EXPECT_EQ(a.pixels.id, b.pixels.id);
        // A compiler may order the sums of the gradient otherwise in a fragment shader.
        ASSERT_EQ(a.pixels.normal.size(), b.pixels.normal.size());
        float worst = 0;
        for (std::size_t i = 0; i < a.pixels.normal.size(); ++i) {
            worst = std::max(worst, std::abs(a.pixels.normal[i] - b.pixels.normal[i]));
        }
        EXPECT_LE(worst, 2e-6F);
        EXPECT_EQ(a.info.hit_pixels, b.info.hit_pixels);
        EXPECT_EQ(b.info.capped_rays, 0U);
    }

    void holdBoxesAgainstTracing(model::FrameRequest request) {
        for (const model::PoleTable table : {model::PoleTable::kOff, model::PoleTable::kOn}) {
            request.quality.pole_table = table;
            request.quality.traversal = model::Traversal::kBvh;
            const model::Frame traced = draw(request);
            request.quality.traversal = model::Traversal::kRasterBoxes;
            const model::Frame drawn = draw(request);
            EXPECT_GT(traced.info.hit_pixels, 800U);
            EXPECT_EQ(drawn.info.request.quality.traversal, model::Traversal::kRasterBoxes);
            expectSamePixels(traced, drawn);
        }
    }

    /// Errors of a tessellated frame against the traced one.
    struct Errors {
        int hits = 0, wrong_pixels = 0;  ///< another id, or nothing in one of the two
        double depth_median = 0;         ///< mm
        double normal_median = 0;        ///< radians
    };
    static Errors compare(const model::Frame& truth, const model::Frame& drawn) {
        Errors errors;
        std::vector<double> depths, normals;
        for (std::size_t i = 0; i < truth.pixels.depth.size(); ++i) {
            const bool hit = truth.pixels.id[4 * i] >= 0;
            errors.hits += hit;
            if (!std::equal(&truth.pixels.id[4 * i], &truth.pixels.id[4 * i] + 4, &drawn.pixels.id[4 * i])) {
                ++errors.wrong_pixels;
                continue;
            }
            if (!hit) continue;
            depths.push_back(std::abs(double(truth.pixels.depth[i]) - double(drawn.pixels.depth[i])));
            const auto at = [i](const model::Frame& f) {
                return glm::dvec3(f.pixels.normal[3 * i], f.pixels.normal[3 * i + 1], f.pixels.normal[3 * i + 2]);
            };
            normals.push_back(std::acos(std::min(1.0, glm::dot(at(truth), at(drawn)))));
        }
        std::ranges::sort(depths);
        std::ranges::sort(normals);
        if (!depths.empty()) errors.depth_median = depths[depths.size() / 2];
        if (!normals.empty()) errors.normal_median = normals[normals.size() / 2];
        return errors;
    }
};

TEST_F(Raster, BoxesGiveTheTracedPictureInPerspectiveAndParallel) {
    const model::ShImage image = randomField({6, false}, {5, 4, 4}, 3, obliqueAffine());
    store.add("field", image);
    for (const bool perspective : {true, false}) {
        model::FrameRequest request = requestOf("field", 150, 110, 2);
        request.quality.samples = 3;
        request.camera = cameraAround(image, {-1, 2, 1}, perspective);
        holdBoxesAgainstTracing(request);
        request.scene.layers[0].glyphs().negative_lobes = model::NegativeLobes::kShown;
        const double distance = glm::length(request.camera.target_mm - request.camera.eye_mm);
        request.camera.clip = model::Clip{distance - 0.7, distance + 1.5};
        holdBoxesAgainstTracing(request);
    }
}

TEST_F(Raster, BoxesGiveTheTracedPictureOfOddBandsFromWithinTheGlyphs) {
    const model::ShImage image = randomField({5, true}, {4, 4, 3}, 7, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 120, 90, 2);
    request.quality.pole_table = model::PoleTable::kOff;
    // The eye in the boxes of several glyphs, and inside of one of them.
    const glm::dvec3 inside = glm::dvec3(image.voxel_to_world * glm::dvec4(1.5, 1.4, 1.6, 1));
    const glm::dvec3 centre = glm::dvec3(image.voxel_to_world * glm::dvec4(2, 2, 1, 1));
    for (const glm::dvec3& eye : {inside, centre + glm::dvec3(0.01, 0.02, 0.01)}) {
        request.camera.perspective = true;
        request.camera.field_of_view_deg = 80;
        request.camera.eye_mm = eye;
        request.camera.target_mm = eye + glm::dvec3(0.5, 0.7, 0.3);
        request.quality.traversal = model::Traversal::kBvh;
        const model::Frame traced = draw(request);
        request.quality.traversal = model::Traversal::kRasterBoxes;
        EXPECT_GT(traced.info.hit_pixels, 500U);
        expectSamePixels(traced, draw(request));
    }
}

TEST_F(Raster, BoxesGiveTheTracedPictureOfATouchingCloseUp) {
    const model::ShImage image = randomField({8, false}, {3, 3, 1}, 5, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 128, 128, 3);
    for (const double share : {0.02, 0.0002}) {
        request.camera = cameraAround(image, {0.3, 0.4, 1}, false);
        request.camera.height_mm *= share;
        request.quality.traversal = model::Traversal::kBvh;
        const model::Frame traced = draw(request);
        request.quality.traversal = model::Traversal::kRasterBoxes;
        expectSamePixels(traced, draw(request));
    }
}

TEST_F(Raster, LayersOfAnyKindMixByDepth) {
    const model::ShImage image = randomField({4, false}, {4, 4, 3}, 11, obliqueAffine());
    store.add("a", image);
    store.add("b", randomField({6, false}, {4, 4, 3}, 12, obliqueAffine()));
    model::FrameRequest request = requestOf("a", 140, 100, 2);
    store.add("c", randomField({2, true}, {4, 4, 3}, 13, obliqueAffine()));
    request.scene.layers.push_back(request.scene.layers[0]);
    request.scene.layers[1].glyphs().dataset_id = "b";
    request.scene.layers.push_back(request.scene.layers[0]);
    request.scene.layers[2].glyphs().dataset_id = "c";
    request.camera = cameraAround(image, {1, -2, 1}, true);
    request.quality.samples = 2;
    holdBoxesAgainstTracing(request);
    request.quality.traversal = model::Traversal::kBvh;
    const model::Frame traced = draw(request);
    request.quality.intersection = model::Intersection::kTessellated;
    request.quality.tessellation.level = 5;
    const model::Frame drawn = draw(request);
    const Errors errors = compare(traced, drawn);
    std::printf("three layers of icospheres of level 5: %d of %d pixels differ\n", errors.wrong_pixels, errors.hits);
    EXPECT_LT(errors.wrong_pixels, errors.hits / 50);
    for (const std::int32_t layer : {0, 1, 2}) {
        int pixels = 0;
        for (std::size_t i = 0; i < drawn.pixels.id.size(); i += 4) pixels += drawn.pixels.id[i] == layer;
        EXPECT_GT(pixels, 50) << "layer " << layer;
    }
}

/// A flat triangle of edge s on a surface of curvature c is off by about c s^2 / 8, and s halves with each level: the error
/// falls by
/// 4. Held to 2.5 in the median; the last level to 1e-3 of the glyph's radius of about 1 mm, its normals to half a degree.
TEST_F(Raster, DeformedSpheresConvergeToTheTracedPicture) {
    const model::ShImage image = randomField({6, false}, {3, 2, 2}, 21, obliqueAffine());
    store.add("field", image);
    for (const bool perspective : {true, false}) {
        model::FrameRequest request = requestOf("field", 240, 180, 2);
        request.camera = cameraAround(image, {1, 1.5, 2}, perspective);
        const model::Frame traced = draw(request);
        request.quality.intersection = model::Intersection::kTessellated;
        for (const SphereMesh mesh : {SphereMesh::kIcosphere, SphereMesh::kOctahedron, SphereMesh::kTetrahedron}) {
            const int first = mesh == SphereMesh::kIcosphere ? 2 : mesh == SphereMesh::kOctahedron ? 3 : 4;
            Errors before;
            for (int level = first; level < first + 4; ++level) {
                request.quality.tessellation = {mesh, level, model::MeshNormals::kAnalytic};
                const model::Frame drawn = draw(request);
                EXPECT_EQ(drawn.info.request.quality.tessellation, request.quality.tessellation);
                EXPECT_EQ(drawn.info.capped_rays, 0U);
                const Errors errors = compare(traced, drawn);
                std::printf("mesh %d, level %d: %d of %d pixels differ, depth %.2g mm, normal %.2g degrees\n", int(mesh), level,
                            errors.wrong_pixels, errors.hits, errors.depth_median, errors.normal_median * 57.3);
                if (level > first) {
                    EXPECT_LT(errors.depth_median, before.depth_median / 2.5);
                    EXPECT_LT(errors.wrong_pixels, before.wrong_pixels);
                }
                before = errors;
            }
            EXPECT_LT(before.depth_median, 1e-3);
            EXPECT_LT(before.normal_median, 0.5 / 57.3);
            EXPECT_LT(before.wrong_pixels, before.hits / 50);
        }
    }
}

TEST_F(Raster, GridsConvergeAndNormalsCanBeThoseOfTheTriangles) {
    const model::ShImage image = randomField({4, true}, {2, 2, 2}, 22, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 160, 120, 2);
    request.scene.layers[0].glyphs().negative_lobes = model::NegativeLobes::kShown;
    request.camera = cameraAround(image, {1, 1.5, 2}, true);
    const model::Frame traced = draw(request);
    request.quality.intersection = model::Intersection::kTessellated;
    double before = 1e9;
    for (const int bands : {7, 10, 20, 60}) {
        request.quality.tessellation = {SphereMesh::kLatitudeLongitude, bands, model::MeshNormals::kAnalytic};
        const Errors smooth = compare(traced, draw(request));
        request.quality.tessellation.normals = model::MeshNormals::kTriangle;
        const Errors flat = compare(traced, draw(request));
        std::printf("grid of %d: depth %.2g mm, normals %.2g and %.2g degrees\n", bands, smooth.depth_median,
                    smooth.normal_median * 57.3, flat.normal_median * 57.3);
        EXPECT_LT(smooth.depth_median, before);
        EXPECT_EQ(smooth.depth_median, flat.depth_median);
        EXPECT_GT(flat.normal_median, 1.3 * smooth.normal_median);
        before = smooth.depth_median;
    }
    EXPECT_LT(before, 2e-3);
}

/// More vertices than are kept at a time: the layer is deformed and drawn part by part, in every sample anew.
TEST_F(Raster, LayersTooLargeToKeepAreDrawnInParts) {
    const model::ShImage image = randomField({2, false}, {12, 12, 6}, 31, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 96, 72, 1);
    request.quality.samples = 2;
    request.camera = cameraAround(image, {1, 1.5, 2}, true);
    const model::Frame traced = draw(request);
    request.quality.intersection = model::Intersection::kTessellated;
    request.quality.tessellation.level = 4;  // 864 glyphs of 2562 vertices of 24 bytes: 53 MB
    const std::uint64_t before = device.allocatedBytes();
    const model::Frame drawn = draw(request);
    EXPECT_LT(device.allocatedBytes() - before, 45'000'000U) << "32 MiB of vertices at a time, and a quarter of room";
    const Errors errors = compare(traced, drawn);
    EXPECT_LT(errors.wrong_pixels, errors.hits / 10);
    ASSERT_EQ(drawn.info.passes.size(), 5U);
    EXPECT_EQ(drawn.info.passes[0].shader, "glyph_tessellate_even2");
    EXPECT_EQ(drawn.info.passes[1].shader, "glyph_mesh");
    EXPECT_EQ(drawn.info.passes[2].shader, "raster_surface");
    for (const model::PassTime& pass : drawn.info.passes) EXPECT_GT(pass.time_ms, 0) << pass.name;
    // A frame that is traced again keeps nothing of it.
    request.quality.intersection = model::Intersection::kMarch;
    draw(request);
    EXPECT_LT(device.allocatedBytes(), before + 1'000'000);
}

TEST_F(Raster, RefusesWhatItDoesNotDraw) {
    store.add("field", randomField({4, false}, {2, 2, 2}, 1, obliqueAffine()));
    model::FrameRequest request = requestOf("field", 40, 30, 2);
    request.quality.intersection = model::Intersection::kTessellated;
    request.quality.tessellation.level = 7;
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kResourceExhausted);
    request.quality.tessellation = {SphereMesh::kLatitudeLongitude, 1, model::MeshNormals::kAnalytic};
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
    request.quality.intersection = model::Intersection::kPolynomial;
    request.quality.traversal = model::Traversal::kRasterBoxes;
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kUnsupported);
}

}  // namespace
}  // namespace radiata::test
