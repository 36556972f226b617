// Cameras and pictures at the edge of what makes sense: very far, inside a glyph, through its centre, a kilometre off, one
// pixel.
#include <cmath>
#include <iostream>
#include <numbers>

#include "image/exact_check.h"
#include "image/fixture.h"
#include "reference/sh_function.h"

namespace radiata::test {
namespace {

class HardViews : public ImageTest {
protected:
    void hold(const model::Frame& frame, const model::ShImage& data, int pixels, int hits_at_least) {
        const ExactCheck check = checkAgainstReference(frame, data, pixels);
        std::cout << check << '\n';
        EXPECT_EQ(check.wrong(), 0) << check;
        EXPECT_GE(check.checked, hits_at_least);
    }
    const model::ShImage image = randomField({6, false}, {4, 3, 3}, 41, obliqueAffine());
};

/// At 1e6 mm, more than 1e6 radii, rays through one pixel's centre differ from parallel ones by 5e-6 of the picture's half
/// height: 3e-4 pixels. So ids are equal in all but a few pixels at silhouettes, and each pixel is what the reference says.
TEST_F(HardViews, FromAMillionRadiiAway) {
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 160, 120, 2);
    request.camera = cameraAround(image, {1, 2, 3}, false);
    const model::Frame parallel = draw(request);
    const glm::dvec3 away = glm::normalize(request.camera.eye_mm - request.camera.target_mm);
    for (const double distance : {1e4, 1e6}) {
        request.camera.perspective = true;
        request.camera.eye_mm = request.camera.target_mm + distance * away;
        request.camera.field_of_view_deg = 2 * std::atan(0.5 * request.camera.height_mm / distance) * 180 / std::numbers::pi;
        for (const model::PoleTable table : {model::PoleTable::kOff, model::PoleTable::kOn}) {
            request.quality.pole_table = table;
            const model::Frame far = draw(request);
            const Agreement agreement = compareSurfaces(parallel, far);
            std::cout << "distance " << distance << ": " << agreement.hits << " hits, " << agreement.other_ids
                      << " other ids\n";
            if (distance > 1e5) {
                EXPECT_LE(agreement.other_ids, 4);
            }
            hold(far, image, 400, 200);
        }
    }
}

TEST_F(HardViews, FromInsideAGlyph) {
    store.add("field", image);
    const glm::dvec3 centre = voxelCentre(image, {1, 1, 1});
    // Inside a lobe and just beside the centre.
    for (const glm::dvec3& offset : {glm::dvec3(0.05, -0.04, 0.06), glm::dvec3(1e-4, 0, -1e-4)}) {
        for (const model::PoleTable table : {model::PoleTable::kOff, model::PoleTable::kOn}) {
            model::FrameRequest request = requestOf("field", 80, 60, 2);
            request.camera.perspective = true;
            request.camera.field_of_view_deg = 100;
            request.camera.eye_mm = centre + offset;
            request.camera.target_mm = request.camera.eye_mm + glm::dvec3(1, 0.3, -0.2);
            request.camera.up = {0, 0, 1};
            request.quality.pole_table = table;
            const model::Frame frame = draw(request);
            EXPECT_FALSE(frame.info.pole_table_used) << frame.info.pole_table_reason;
            hold(frame, image, 600, 200);
        }
    }
}

/// All lobes begin at the centre, so a rounding of the eye decides in which of them it is; but what is drawn lies on its glyph.
TEST_F(HardViews, FromTheCentreOfAGlyph) {
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 80, 60, 2);
    request.camera.perspective = true;
    request.camera.field_of_view_deg = 100;
    request.camera.eye_mm = voxelCentre(image, {1, 1, 1});
    request.camera.target_mm = request.camera.eye_mm + glm::dvec3(1, 0.3, -0.2);
    request.camera.up = {0, 0, 1};
    const model::Frame frame = draw(request);
    double worst = 0;
    int hits = 0;
    for (std::size_t at = 0; at < frame.pixels.depth.size(); ++at) {
        if (frame.pixels.id[4 * at] < 0) continue;
        const glm::ivec3 voxel(frame.pixels.id[4 * at + 1], frame.pixels.id[4 * at + 2], frame.pixels.id[4 * at + 3]);
        const auto slot = static_cast<std::size_t>(voxel.x + image.size.x * (voxel.y + image.size.y * voxel.z));
        const std::size_t stride = image.layout.count();
        const reference::ShFunction f(image.layout, std::span(image.coefficients).subspan(slot * stride, stride));
        const glm::dvec3 position(frame.pixels.position[3 * at], frame.pixels.position[3 * at + 1],
                                  frame.pixels.position[3 * at + 2]);
        const glm::dvec3 offset = position + frame.info.position_origin_mm - voxelCentre(image, voxel);
        if (glm::length(offset) < 1e-3) continue;
        ++hits;
        // Along the normal: radii change much faster than that where lobes are steep.
        const double slope = 2 * glm::length(f.gradient(offset)) / glm::length(offset);
        worst = std::max(worst, std::abs(glm::length(offset) - 2 * f(offset)) / std::sqrt(1 + slope * slope));
    }
    std::cout << hits << " hits off the centre, at most " << worst << " mm from the surface\n";
    EXPECT_GT(hits, 1000);
    EXPECT_LE(worst, 2e-5);
}

/// An odd number of pixels, so that the middle one's ray passes through the centre exactly; the others within 1e-4 to 1e-2 mm.
TEST_F(HardViews, ThroughTheCentreAndParallelToTheAxes) {
    const model::ShImage aligned = randomField({8, false}, {1, 1, 1}, 42, glm::dmat4(1.0));
    store.add("one", aligned);
    for (const glm::dvec3& towards : {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0)}) {
        for (const double height : {65e-4, 0.5}) {
            model::FrameRequest request = requestOf("one", 65, 65, 2);
            request.camera = cameraAround(aligned, towards, false);
            request.camera.height_mm = height;
            hold(draw(request), aligned, 300, 100);
        }
    }
}

TEST_F(HardViews, AKilometreFromTheOrigin) {
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 160, 120, 2);
    for (const bool perspective : {true, false}) {
        request.camera = cameraAround(image, {1, 2, 3}, perspective);
        const model::Frame here = draw(request);
        model::ShImage moved = image;
        const glm::dvec3 move(6e5, -7e5, 4e5);
        moved.voxel_to_world[3] += glm::dvec4(move, 0.0);
        const std::string id = perspective ? "moved" : "moved-parallel";
        store.add(id, moved);
        model::FrameRequest there = request;
        there.scene.layers[0].glyphs().dataset_id = id;
        there.camera.eye_mm += move;
        there.camera.target_mm += move;
        const model::Frame frame = draw(there);
        int other = 0;
        for (std::size_t at = 0; at < frame.pixels.rgba.size(); at += 4) {
            int worst = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                worst = std::max(worst, std::abs(frame.pixels.rgba[at + c] - here.pixels.rgba[at + c]));
            }
            other += worst > 1;
        }
        // Positions of voxels in double round at 1e-10 mm there, after which the frames are the same.
        std::cout << other << " pixels differ by more than one step\n";
        EXPECT_LE(other, 2);
        hold(frame, moved, 300, 100);
    }
}

TEST_F(HardViews, OfOnePixelAndOfOneRow) {
    store.add("field", image);
    for (const glm::ivec2& size : {glm::ivec2(1, 1), glm::ivec2(8192, 1), glm::ivec2(1, 8192), glm::ivec2(7, 3)}) {
        model::FrameRequest request = requestOf("field", size.x, size.y, 2);
        request.camera = cameraAround(image, {1, 2, 3}, true);
        request.camera.target_mm = voxelCentre(image, {1, 1, 2});
        request.camera.field_of_view_deg = size.x > 1000 ? 0.01 : 20;
        for (const model::Traversal traversal : {model::Traversal::kTiles, model::Traversal::kBvh}) {
            request.quality.traversal = traversal;
            const model::Frame frame = draw(request);
            EXPECT_EQ(frame.pixels.depth.size(), static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
            EXPECT_GE(frame.info.hit_pixels, 1U);
            hold(frame, image, 100, 1);
        }
    }
}

TEST_F(HardViews, OverTheLimitAreRefused) {
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 8193, 1, 2);
    request.camera = cameraAround(image, {1, 2, 3}, true);
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kResourceExhausted);
    request.width = request.height = 8192;
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kResourceExhausted);
    request.width = 0;
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
    request.width = request.height = 16;
    request.scene.layers[0].glyphs().dataset_id = "no-such";
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kNotFound);
    request.scene.layers[0].glyphs().dataset_id = "field";
    request.camera.up = request.camera.eye_mm - request.camera.target_mm;
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
    request.camera.up = {0, 0, 1};
    request.camera.eye_mm.x = std::nan("");
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
    // Nothing of it stays: the next picture is drawn.
    request.camera = cameraAround(image, {1, 2, 3}, true);
    EXPECT_GT(draw(request).info.hit_pixels, 10U);
}

}  // namespace
}  // namespace radiata::test
