// Fibres in pictures: who is seen in each pixel against the reference in double, what culling must not change, what the
// settings of a layer do.
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <set>

#include "build/glyph_instances.h"
#include "image/fibre_scenes.h"
#include "image/fixture.h"
#include "reference/fibre_depth_cues.h"
#include "reference/shading.h"

namespace radiata::test {
namespace {

class FibrePictures : public ImageTest {
protected:
    static std::uint32_t whoOf(const model::FibletSet& set, const std::int32_t* id) {
        if (id[0] < 0) return reference::FibrePixel::kNobody;
        const auto fibre = static_cast<std::uint32_t>(id[1]), point = static_cast<std::uint32_t>(id[2]);
        const std::uint32_t fiblet = set.fibre_fiblets[set.fibre_first[fibre] + point / shader::FIBLET_SEGMENTS];
        return fiblet << shader::FIBLET_SEGMENT_BITS | point % shader::FIBLET_SEGMENTS;
    }

    /// Pixels that the reference is sure of and that show something or somebody else.
    void compare(const model::FibletSet& set, const model::FrameRequest& request, int line_width, double& sure_share) {
        const model::Frame frame = draw(request);
        const auto expected =
            reference::fibrePicture(decodedSegments(set), request.camera, request.width, request.height, line_width);
        int wrong = 0, sure = 0, shown = 0;
        double worst_depth = 0;
        for (std::size_t at = 0; at < expected.size(); ++at) {
            if (!expected[at].sure) continue;
            ++sure;
            const std::uint32_t who = whoOf(set, &frame.pixels.id[4 * at]);
            wrong += who != expected[at].who;
            if (who != expected[at].who || who == reference::FibrePixel::kNobody) continue;
            ++shown;
            const double depth = static_cast<double>(frame.pixels.depth[at]) + frame.info.depth_offset_mm;
            worst_depth = std::max(worst_depth, std::abs(depth - expected[at].depth_mm));
        }
        EXPECT_EQ(wrong, 0) << "of " << sure;
        EXPECT_GT(shown, 100);
        EXPECT_LT(worst_depth, 1e-3);
        sure_share = sure / static_cast<double>(expected.size());
    }
};

/// Ids equal the reference's wherever it is sure; depths to 1 um.
TEST_F(FibrePictures, ShowTheSegmentsThatTheReferenceFinds) {
    const glm::dvec3 centre(13, -40, 22);
    const model::FibletSet set = randomTractogram(7, 40, 200, 0.4, 15, centre);
    store.add("fibres", set);
    model::FrameRequest request = fibreRequest("fibres", 160, 120);
    double sure = 0;
    for (const bool perspective : {false, true}) {
        request.camera.perspective = perspective;
        request.camera.target_mm = centre;
        request.camera.eye_mm = centre + glm::dvec3(60, -50, 70);
        request.camera.height_mm = 50;
        request.camera.field_of_view_deg = 30;
        compare(set, request, 1, sure);
        EXPECT_GT(sure, 0.9);
        // A close-up, in which segments are many pixels long.
        request.camera.height_mm = 6;
        request.camera.field_of_view_deg = 4;
        compare(set, request, 1, sure);
        EXPECT_GT(sure, 0.9);
        request.scene.layers[0].tracts().line_width_px = 3;
        compare(set, request, 3, sure);
        EXPECT_GT(sure, 0.8);
        request.scene.layers[0].tracts().line_width_px = 1;
    }
}

/// Culled and unculled frames have the same bytes and ids, whatever was seen before: 2,000 cameras in a random walk of
/// jumps, 20,000 with RADIATA_FULL set.
TEST_F(FibrePictures, DoNotDependOnCulling) {
    const glm::dvec3 centre(-3, 8, 1);
    const model::FibletSet set = randomTractogram(8, 150, 300, 0.3, 8, centre);
    store.add("fibres", set);
    std::mt19937 random(9);
    render::Target kept;
    const char* full = std::getenv("RADIATA_FULL");
    const int cameras = full && *full ? 20'000 : 2'000;
    int shown = 0;
    for (int i = 0; i < cameras; ++i) {
        model::FrameRequest request = fibreRequest("fibres", 32, 24);
        request.camera = randomCamera(random, centre, 15);
        if (i % 5 == 0) request.scene.layers[0].tracts().line_width_px = 5;
        if (i % 7 == 0) request.scene.layers[0].tracts().tube_radius_mm = 0.3F;
        request.quality.fiblet_culling = model::FibletCulling::kNone;
        const model::Frame all = draw(request);
        request.quality.fiblet_culling = model::FibletCulling::kTwoPhase;
        const model::Frame culled = renderer.render(kept, request, 0, 1, everything());
        ASSERT_EQ(all.pixels.id, culled.pixels.id) << i;
        ASSERT_EQ(all.pixels.depth, culled.pixels.depth) << i;
        ASSERT_EQ(all.pixels.rgba, culled.pixels.rgba) << i;
        if (i % 10 == 0) {
            request.quality.fiblet_culling = model::FibletCulling::kFrustum;
            ASSERT_EQ(all.pixels.id, draw(request).pixels.id) << i;
        }
        shown += all.info.hit_pixels > 60;
    }
    EXPECT_GT(shown, cameras * 2 / 5) << "cameras that see something";
}

TEST_F(FibrePictures, ShowGroupsSelectionsAndCuts) {
    model::FibletSet set = randomTractogram(10, 60, 150, 0.4, 12);
    set.groups.resize(2);
    set.groups[0].name = "left";
    set.groups[1].name = "right";
    for (std::uint32_t f = 0; f < 60; ++f) set.groups[f % 3 == 0 ? 1 : 0].fibres.push_back(f);
    store.add("fibres", set);
    model::FrameRequest request = fibreRequest("fibres", 160, 120, 2);
    request.camera.eye_mm = {40, 30, 50};
    request.camera.height_mm = 40;
    model::TractogramLayer& layer = request.scene.layers[0].tracts();
    const auto fibresSeen = [&] {
        const model::Frame frame = draw(request);
        std::set<int> seen;
        for (std::size_t at = 0; at < frame.pixels.depth.size(); ++at) {
            if (frame.pixels.id[4 * at] >= 0) seen.insert(frame.pixels.id[4 * at + 1]);
        }
        return seen;
    };
    EXPECT_GT(fibresSeen().size(), 50);
    layer.shown.groups = {"right"};
    for (const int fibre : fibresSeen()) EXPECT_EQ(fibre % 3, 0);
    layer.shown = {};
    layer.selected.emplace().groups = {"left"};
    EXPECT_GT(fibresSeen().size(), 50) << "the others are dimmed, not hidden";
    layer.unselected = model::UnselectedFibres::kHidden;
    for (const int fibre : fibresSeen()) EXPECT_NE(fibre % 3, 0);
    layer.selected.reset();
    layer.shown.fibres = {5, 17};
    EXPECT_EQ(fibresSeen(), (std::set<int>{5, 17}));
    layer.shown.fibres = {60};
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
    layer.shown = {};
    layer.shown.groups = {"middle"};
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
    layer.shown = {};
    // A slab of 4 mm: nothing is seen outside of it.
    layer.cuts = {{{0, 0, 2}, {0, 0, 1}}, {{0, 0, -2}, {0, 0, -3}}};
    for (const model::FibletCulling culling : {model::FibletCulling::kTwoPhase, model::FibletCulling::kNone}) {
        request.quality.fiblet_culling = culling;
        const model::Frame frame = draw(request);
        EXPECT_GT(frame.info.hit_pixels, 300);
        for (std::size_t at = 0; at < frame.pixels.depth.size(); ++at) {
            if (frame.pixels.id[4 * at] < 0) continue;
            const double z = frame.info.position_origin_mm.z + static_cast<double>(frame.pixels.position[3 * at + 2]);
            // Within half a pixel, a quarter millimetre, of the plane.
            ASSERT_LT(std::abs(z), 2.25);
        }
    }
}

/// Every pixel's pick is what the picture shows there; with a radius the nearest fibre around it; places lie on the fibre.
TEST_F(FibrePictures, ArePickedWhereTheyAreSeen) {
    model::FibletSet set = randomTractogram(12, 30, 150, 0.4, 12, {100, -50, 30});
    set.fibre_columns.push_back({"weight", 1, {}});
    for (std::uint32_t f = 0; f < 30; ++f) set.fibre_columns[0].values.push_back(0.5F * static_cast<float>(f));
    set.groups.resize(1);
    set.groups[0].name = "even";
    for (std::uint32_t f = 0; f < 30; f += 2) set.groups[0].fibres.push_back(f);
    const std::vector<reference::FibreSegment> segments = decodedSegments(set);
    store.add("fibres", set);
    model::FrameRequest request = fibreRequest("fibres", 64, 48);
    request.camera.target_mm = {100, -50, 30};
    request.camera.eye_mm = {140, -20, 80};
    request.camera.perspective = true;
    const model::Frame frame = draw(request);
    int hits = 0, beside = 0;
    for (int y = 0; y < request.height; ++y) {
        for (int x = 0; x < request.width; x += 3) {
            const auto at = static_cast<std::size_t>(y * request.width + x);
            const auto picked = renderer.pick(request, x, y);
            ASSERT_EQ(picked.has_value(), frame.pixels.id[4 * at] >= 0) << x << ", " << y;
            const auto near = renderer.pick(request, x, y, 3);
            beside += near.has_value() && !picked;
            if (!picked) continue;
            ++hits;
            const auto& fibre = std::get<model::PickedFibre>(*picked);
            ASSERT_EQ(fibre.fibre, frame.pixels.id[4 * at + 1]);
            ASSERT_EQ(fibre.point, frame.pixels.id[4 * at + 2]);
            const auto segment =
                std::ranges::find(segments, whoOf(set, &frame.pixels.id[4 * at]), &reference::FibreSegment::who);
            const glm::dvec3 along = segment->to - segment->from, way = fibre.position_mm - segment->from;
            EXPECT_LT(glm::length(glm::cross(way, glm::normalize(along))), 1e-3);
            EXPECT_LT(glm::length(way), glm::length(along) + 1e-3);
            EXPECT_EQ(fibre.groups.size(), fibre.fibre % 2 == 0 ? 1 : 0);
            EXPECT_EQ(fibre.values.at(0), (model::FibreValue{"weight", {0.5F * static_cast<float>(fibre.fibre)}}));
            EXPECT_EQ(std::get<model::PickedFibre>(*near).fibre, fibre.fibre) << "the pixel itself is nearest";
        }
    }
    EXPECT_GT(hits, 100);
    EXPECT_GT(beside, 50);
    EXPECT_EQ(codeOf([&] { renderer.pick(request, 1, 1, 65); }), Code::kInvalidArgument);
}

/// From the frozen camera itself nothing is missing; from the other side only fibres that it sees are there.
TEST_F(FibrePictures, ShowWhatAFrozenCameraSees) {
    const model::FibletSet set = randomTractogram(14, 200, 300, 0.3, 8);
    store.add("fibres", set);
    model::FrameRequest request = fibreRequest("fibres", 96, 72);
    request.camera.eye_mm = {40, 30, 50};
    request.camera.height_mm = 8;
    const model::Frame plain = draw(request);
    request.quality.frozen_culling = request.camera;
    const model::Frame same = draw(request);
    EXPECT_EQ(plain.pixels.id, same.pixels.id);
    EXPECT_EQ(plain.pixels.rgba, same.pixels.rgba);
    std::set<std::uint32_t> seen;
    for (std::size_t at = 0; at < plain.pixels.depth.size(); ++at) {
        if (plain.pixels.id[4 * at] >= 0) seen.insert(whoOf(set, &plain.pixels.id[4 * at]) >> shader::FIBLET_SEGMENT_BITS);
    }
    request.camera.eye_mm = {-50, 40, -20};
    request.camera.height_mm = 30;
    const model::Frame other = draw(request);
    int shown = 0;
    for (std::size_t at = 0; at < other.pixels.depth.size(); ++at) {
        if (other.pixels.id[4 * at] < 0) continue;
        ++shown;
        ASSERT_TRUE(seen.contains(whoOf(set, &other.pixels.id[4 * at]) >> shader::FIBLET_SEGMENT_BITS));
    }
    EXPECT_GT(shown, 200);
    request.quality.frozen_culling.reset();
    EXPECT_GT(draw(request).info.hit_pixels, other.info.hit_pixels);
}

/// Halos: black where the reference says so from the depths, elsewhere the same bytes; up to 1 % of pixels hang on the rounding
/// of a depth. Occlusion: 16 places a pixel estimate the reference's mean over the disc, without bias (0.02) and to 0.1 on
/// average.
TEST_F(FibrePictures, HaveHalosAndOcclusionByTheirDepths) {
    store.add("fibres", randomTractogram(13, 200, 200, 0.3, 10));
    model::FrameRequest request = fibreRequest("fibres", 160, 120);
    request.camera.eye_mm = {40, 30, 50};
    request.camera.height_mm = 30;
    const double size_mm = request.camera.height_mm / request.height;
    model::TractogramLayer& layer = request.scene.layers[0].tracts();
    layer.colour.mode = model::FibreColourMode::kUniform;
    const model::Frame plain = draw(request);
    layer.halo_px = 3.0F;
    const model::Frame halos = draw(request);
    layer.halo_px.reset();
    layer.occlusion_px = 10.0F;
    const model::Frame occluded = draw(request);
    int hidden = 0, wrong = 0, fibres = 0;
    double bias = 0, off = 0;
    for (int y = 0; y < request.height; ++y) {
        for (int x = 0; x < request.width; ++x) {
            const auto at = static_cast<std::size_t>(y * request.width + x);
            if (plain.pixels.id[4 * at] < 0) continue;
            ++fibres;
            const bool halo = reference::inHalo(plain.pixels.depth, request.width, request.height, x, y, 3, size_mm);
            hidden += halo;
            for (std::size_t c = 4 * at; c < 4 * at + 3; ++c) {
                if (halos.pixels.rgba[c] != (halo ? 0 : plain.pixels.rgba[c])) {
                    ++wrong;
                    break;
                }
            }
            const double before = reference::linearFromSrgb(plain.pixels.rgba[4 * at] / 255.0);
            const double after = reference::linearFromSrgb(occluded.pixels.rgba[4 * at] / 255.0);
            const double expected = reference::openness(plain.pixels.depth, request.width, request.height, x, y, 10, size_mm);
            bias += after / before - expected;
            off += std::abs(after / before - expected);
        }
    }
    EXPECT_GT(hidden, fibres / 20);
    EXPECT_LT(hidden, fibres * 9 / 10);
    EXPECT_LT(wrong, fibres / 100);
    EXPECT_LT(std::abs(bias / fibres), 0.02);
    EXPECT_LT(off / fibres, 0.1);
}

/// Lines hide glyphs and are hidden by them; equal requests give equal bytes; scenes without fibres have none of their passes.
TEST_F(FibrePictures, ShareThePictureWithGlyphs) {
    const model::ShImage image = randomField({4, false}, {3, 3, 2}, 51, obliqueAffine());
    store.add("field", image);
    glm::dvec3 low, high;
    datasetBounds(image, low, high);
    store.add("fibres", randomTractogram(11, 80, 200, 0.1, 0.5 * glm::length(high - low), 0.5 * (low + high)));
    model::FrameRequest glyphs = requestOf("field", 160, 120, 3);
    glyphs.camera = cameraAround(image, {1, 2, 3}, true);
    model::FrameRequest fibres = glyphs, both = glyphs;
    fibres.scene.layers = fibreRequest("fibres", 1, 1).scene.layers;
    both.scene.layers.insert(both.scene.layers.begin(), fibres.scene.layers[0]);
    const model::Frame g = draw(glyphs), f = draw(fibres), b = draw(both);
    for (const model::PassTime& pass : g.info.passes) EXPECT_EQ(pass.name.find("fiblet"), std::string::npos);
    std::swap(both.scene.layers[0], both.scene.layers[1]);
    const model::Frame turned = draw(both);
    int of_fibres = 0, of_glyphs = 0;
    for (std::size_t at = 0; at < b.pixels.depth.size(); ++at) {
        const double depth_g = static_cast<double>(g.pixels.depth[at]) + g.info.depth_offset_mm;
        const double depth_f = static_cast<double>(f.pixels.depth[at]) + f.info.depth_offset_mm;
        if (std::abs(depth_g - depth_f) < 1e-3) continue;
        const bool nothing = !std::isfinite(std::min(depth_g, depth_f));
        const int layer = nothing ? -1 : depth_f < depth_g ? 0 : 1;
        ASSERT_EQ(b.pixels.id[4 * at], layer) << at;
        ASSERT_EQ(turned.pixels.id[4 * at], nothing ? -1 : 1 - layer) << at;
        of_fibres += layer == 0;
        of_glyphs += layer == 1;
    }
    EXPECT_GT(of_fibres, 300);
    EXPECT_GT(of_glyphs, 300);
    EXPECT_EQ(draw(both).pixels.rgba, turned.pixels.rgba);
}

}  // namespace
}  // namespace radiata::test
