// What regions, columns and selections leave of a layer of fibres, and what colours it, against the segments in double.
#include <atomic>
#include <cmath>
#include <set>
#include <thread>

#include "build/sphere_mesh.h"
#include "image/fibre_scenes.h"
#include "image/fixture.h"
#include "reference/colour_map.h"
#include "reference/shading.h"

namespace radiata::test {
namespace {

class FibreFilters : public ImageTest {
protected:
    /// 60 fibres about the origin with a column per fibre, f / 10, and one per point, x.
    static model::FibletSet columned() {
        model::FibletSet made = randomTractogram(21, 60, 150, 0.4, 12);
        made.fibre_columns.push_back({"weight", 1, {}});
        for (std::uint32_t f = 0; f < 60; ++f) made.fibre_columns[0].values.push_back(0.1F * static_cast<float>(f));
        model::PointColumn& column = made.point_columns.emplace_back();
        column.name = "x";
        column.ranges.assign(made.heads.size(), {-40, 40});
        column.values.assign(64 * made.heads.size(), 255);
        for (const reference::FibreSegment& s : decodedSegments(made)) {
            const std::uint32_t fiblet = s.who >> 6U, i = s.who & 63U;
            column.values[64 * fiblet + i] = static_cast<std::uint8_t>(std::lround((s.from.x + 40) / 80 * 254));
            column.values[64 * fiblet + i + 1] = static_cast<std::uint8_t>(std::lround((s.to.x + 40) / 80 * 254));
        }
        return made;
    }

    void SetUp() override {
        set = columned();
        store.add("fibres", set);
        segments = decodedSegments(set);
        request = fibreRequest("fibres", 160, 120);
        request.camera.eye_mm = {40, 30, 50};
        request.camera.height_mm = 40;
        // Light from nowhere: what is seen is the base colour.
        request.scene.light.irradiance = 0;
        request.scene.light.ambient = 1;
    }

    model::TractogramLayer& layer() { return request.scene.layers[0].tracts(); }

    /// Calls body(pixel, segment, frame) for each pixel that shows one. \return  how many
    template <typename Body>
    int forSeen(Body&& body) {
        const model::Frame frame = draw(request);
        int count = 0;
        for (std::size_t at = 0; at < frame.pixels.depth.size(); ++at) {
            const std::int32_t* id = &frame.pixels.id[4 * at];
            if (id[0] < 0) continue;
            const auto fibre = static_cast<std::uint32_t>(id[1]), point = static_cast<std::uint32_t>(id[2]);
            const std::uint32_t who = set.fibre_fiblets[set.fibre_first[fibre] + point / 63] << 6U | point % 63;
            body(at, *std::ranges::find(segments, who, &reference::FibreSegment::who), frame);
            ++count;
        }
        return count;
    }

    model::FibletSet set;
    std::vector<reference::FibreSegment> segments;
    model::FrameRequest request;
};

/// What is seen lies inside, or outside; with and without culling alike; a mesh of a box cuts as the box does.
TEST_F(FibreFilters, CutByRegions) {
    model::TriangleMesh mesh;
    for (int c = 0; c < 8; ++c) mesh.points.emplace_back(c & 1 ? 6 : -6, c & 2 ? 6 : -6, c & 4 ? 6 : -6);
    for (const glm::uvec4& f : {glm::uvec4(0, 2, 3, 1), glm::uvec4(4, 5, 7, 6), glm::uvec4(0, 1, 5, 4), glm::uvec4(2, 6, 7, 3),
                                glm::uvec4(0, 4, 6, 2), glm::uvec4(1, 3, 7, 5)}) {
        mesh.triangles.emplace_back(f.x, f.y, f.z);
        mesh.triangles.emplace_back(f.x, f.z, f.w);
    }
    store.add("box", mesh);
    const auto middle = [](const reference::FibreSegment& s) { return 0.5 * (s.from + s.to); };
    const int all = forSeen([](auto...) {});
    layer().region_cuts = {{"sphere(2, 0, 0, 7)", false}};
    const auto from = [&](const reference::FibreSegment& s) { return glm::length(middle(s) - glm::dvec3(2, 0, 0)); };
    const int inside = forSeen([&](std::size_t, const reference::FibreSegment& s, const auto&) { ASSERT_LT(from(s), 7.001); });
    layer().region_cuts[0].outside = true;
    const int outside = forSeen([&](std::size_t, const reference::FibreSegment& s, const auto&) { ASSERT_GT(from(s), 6.999); });
    EXPECT_GT(inside, 100);
    EXPECT_GT(outside, 500);
    EXPECT_GE(inside + outside, all);
    layer().region_cuts = {{"box(-6, -6, -6, 6, 6, 6)", true}, {"plane(0, 0, 0, 0, 0, 1)", false}};
    const model::Frame by_box = draw(request);
    EXPECT_GT(by_box.info.hit_pixels, 200);
    forSeen([&](std::size_t, const reference::FibreSegment& s, const auto&) { ASSERT_LT(middle(s).z, 1e-3); });
    layer().region_cuts[0].region = "mesh(box)";
    EXPECT_EQ(draw(request).pixels.id, by_box.pixels.id);
    request.quality.fiblet_culling = model::FibletCulling::kNone;
    EXPECT_EQ(draw(request).pixels.id, by_box.pixels.id);
    // Other pipelines cut alike.
    for (const auto pipeline : {model::FibletPipeline::kPull, model::FibletPipeline::kMesh, model::FibletPipeline::kPoints}) {
        request.quality.fiblet_pipeline = pipeline;
        const int seen = forSeen([&](std::size_t, const reference::FibreSegment& s, const auto&) {
            const glm::dvec3 p = middle(s);
            ASSERT_LT(p.z, 1e-3) << model::pipelineName(pipeline);
            ASSERT_GT(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 5.999) << model::pipelineName(pipeline);
        });
        EXPECT_GT(seen, 200) << model::pipelineName(pipeline);
    }
    request.quality.fiblet_pipeline = model::FibletPipeline::kAuto;
    layer().region_cuts[0].region = "mesh(nobody)";
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kNotFound);
    layer().region_cuts[0].region = "mesh(fibres)";
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
    layer().region_cuts[0].region = "length(1, 2)";
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
}

/// A mesh's nearest front and farthest back face cut as its inside does if it is convex: where pictures differ, one of them
/// shows a point within half a segment and a pixel of the surface. If it is concave, many pixels differ elsewhere.
TEST_F(FibreFilters, CutByDepthsFailsWhereMeshesAreConcave) {
    const SphereTriangles ball = sphereMesh(model::SphereMesh::kIcosphere, 4);
    model::TriangleMesh sphere, ring;
    for (const glm::vec3& d : ball.directions) sphere.points.push_back(7.0F * d);
    for (std::size_t i = 0; i < ball.triangles.size(); i += 3)  // inside out, which is nothing to it
        sphere.triangles.emplace_back(ball.triangles[i + 1], ball.triangles[i], ball.triangles[i + 2]);
    constexpr std::uint32_t kAround = 64, kAcross = 32;
    for (std::uint32_t i = 0; i < kAround * kAcross; ++i) {
        const double a = 2 * M_PI * (i / kAcross) / kAround, b = 2 * M_PI * (i % kAcross) / kAcross;
        ring.points.emplace_back((9 + 3 * std::cos(b)) * std::cos(a), (9 + 3 * std::cos(b)) * std::sin(a), 3 * std::sin(b));
        const auto at = [&](std::uint32_t u, std::uint32_t v) {
            return (i / kAcross + u) % kAround * kAcross + (i % kAcross + v) % kAcross;
        };
        ring.triangles.emplace_back(at(0, 0), at(1, 0), at(1, 1));
        ring.triangles.emplace_back(at(0, 0), at(1, 1), at(0, 1));
    }
    store.add("sphere", sphere);
    store.add("ring", ring);
    store.add("many", randomTractogram(43, 150, 120, 0.4, 8));
    layer().dataset_id = "many";
    request.camera.eye_mm = {50, 10, 7};
    request.camera.height_mm = 26;
    const auto fromSphere = [](const glm::dvec3& p) { return std::abs(glm::length(p) - 7); };
    const auto fromRing = [](const glm::dvec3& p) { return std::abs(std::hypot(std::hypot(p.x, p.y) - 9, p.z) - 3); };
    // Pixels that differ, and those of them where neither picture shows a point at the surface.
    const auto differences = [&](const std::string& region, bool outside, auto&& distance) {
        layer().region_cuts = {{region, outside, false}};
        const model::Frame right = draw(request);
        layer().region_cuts[0].by_depths = true;
        const model::Frame cut = draw(request);
        EXPECT_GT(cut.info.hit_pixels, 300);
        int differ = 0, faulty = 0;
        for (std::size_t at = 0; at < right.pixels.depth.size(); ++at) {
            const auto same = [&](std::size_t c) { return right.pixels.id[4 * at + c] == cut.pixels.id[4 * at + c]; };
            if (same(0) && same(1) && same(2)) continue;
            ++differ;
            double nearest = 1e300;
            for (const model::Frame* frame : {&right, &cut}) {
                if (frame->pixels.id[4 * at] < 0) continue;
                const float* p = &frame->pixels.position[3 * at];
                nearest = std::min(nearest, distance(frame->info.position_origin_mm + glm::dvec3(p[0], p[1], p[2])));
            }
            faulty += nearest > 0.5;
        }
        std::printf("%s, %s: %d pixels differ, %d of them faulty\n", region.c_str(), outside ? "outside" : "inside", differ,
                    faulty);
        return faulty;
    };
    for (const bool perspective : {false, true}) {
        request.camera.perspective = perspective;
        for (const bool outside : {false, true}) EXPECT_EQ(differences("mesh(sphere)", outside, fromSphere), 0);
        for (const bool outside : {false, true}) EXPECT_GT(differences("mesh(ring)", outside, fromRing), 100);
    }
    // Culled and not, the same; and other pipelines refuse.
    const model::Frame culled = draw(request);
    request.quality.fiblet_culling = model::FibletCulling::kNone;
    EXPECT_EQ(draw(request).pixels.id, culled.pixels.id);
    request.quality.fiblet_pipeline = model::FibletPipeline::kPoints;
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kUnsupported);
    request.quality.fiblet_pipeline = model::FibletPipeline::kAuto;
    layer().region_cuts = {{"sphere(0, 0, 0, 5)", false, true}};
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
    layer().region_cuts = {{"mesh(ring)", false, true}, {"mesh(sphere)", false, true}};
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
}

TEST_F(FibreFilters, KeepWhatMeetsCriteria) {
    layer().criteria = {{"weight", 1.95F, 4.05F}};
    EXPECT_GT(forSeen([&](std::size_t at, const auto&, const model::Frame& frame) {
                  ASSERT_GE(frame.pixels.id[4 * at + 1], 20);
                  ASSERT_LE(frame.pixels.id[4 * at + 1], 40);
              }),
              200);
    layer().criteria = {{"x", 0, INFINITY}};
    // Bytes stand for steps of 80 / 254 mm.
    EXPECT_GT(forSeen([&](std::size_t, const reference::FibreSegment& s, const auto&) { ASSERT_GT(s.from.x + s.to.x, -0.4); }),
              300);
    layer().criteria = {{"y", 0, 1}};
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
    layer().criteria = {{"x", 1, 0}};
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
}

/// A selection shows the fibres that the brute-force answer has; with another it stands out while the rest is dimmed.
TEST_F(FibreFilters, ShowSelections) {
    std::set<int> expected;
    for (const reference::FibreSegment& s : segments) {
        const glm::dvec3 d = s.to - s.from;
        const double t = std::clamp(-glm::dot(s.from, d) / glm::dot(d, d), 0.0, 1.0);
        if (glm::length(s.from + t * d) <= 4) expected.insert(static_cast<int>(set.heads[s.who >> 6U].fibre));
    }
    ASSERT_GE(expected.size(), 3);
    layer().shown.selection = "any sphere(0, 0, 0, 4)";
    std::set<int> seen;
    forSeen([&](std::size_t at, const auto&, const model::Frame& frame) { seen.insert(frame.pixels.id[4 * at + 1]); });
    EXPECT_EQ(seen, expected);
    layer().shown = {};
    layer().colour.mode = model::FibreColourMode::kUniform;
    layer().colour.uniform = glm::vec3(1);
    layer().selected.emplace().selection = "any sphere(0, 0, 0, 4)";
    forSeen([&](std::size_t at, const auto&, const model::Frame& frame) {
        ASSERT_EQ(frame.pixels.rgba[4 * at] == 255, expected.contains(frame.pixels.id[4 * at + 1]));
    });
    layer().selected->selection = "any sphere(";
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
}

/// Base colours to 2 of 255 steps, by the table's reference.
TEST_F(FibreFilters, AreColouredByPointsEndsAndDistance) {
    const auto table = std::span<const glm::vec3>(linearColourTable(ColourMap::kGrey));
    const auto grey = [&](double value, double low, double high) {
        return 255 * reference::srgbFromLinear(reference::mappedColour(table, value, low, high).x);
    };
    layer().colour.map = ColourMap::kGrey;
    layer().colour.mode = model::FibreColourMode::kPointColumn;
    layer().colour.column = "x";
    layer().colour.range = model::FibreColourRange{-20, 20};
    EXPECT_GT(forSeen([&](std::size_t at, const reference::FibreSegment& s, const model::Frame& frame) {
                  // Rounding to bytes: half a step of 80 / 254 mm.
                  ASSERT_NEAR(frame.pixels.rgba[4 * at], grey(0.5 * (s.from.x + s.to.x), -20, 20), 2 + 255 * 0.16 / 40);
              }),
              500);
    layer().colour.mode = model::FibreColourMode::kDistance;
    layer().colour.region = "sphere(1, 2, 3, 5)";
    layer().colour.range = model::FibreColourRange{0, 30};
    forSeen([&](std::size_t at, const reference::FibreSegment& s, const model::Frame& frame) {
        const double away = std::max(glm::length(0.5 * (s.from + s.to) - glm::dvec3(1, 2, 3)) - 5, 0.0);
        // Two steps of a grid over some 100 mm, and half a segment and pixel.
        ASSERT_NEAR(frame.pixels.rgba[4 * at], grey(away, 0, 30), 2 + 255 * 2.0 / 30) << away;
    });
    layer().colour.range.reset();
    layer().colour.mode = model::FibreColourMode::kEnds;
    forSeen([&](std::size_t at, const reference::FibreSegment& s, const model::Frame& frame) {
        const std::uint32_t fibre = set.heads[s.who >> 6U].fibre;
        const std::uint32_t first = set.fibre_fiblets[set.fibre_first[fibre]] << 6U;
        const std::uint32_t last = set.fibre_fiblets[set.fibre_first[fibre + 1] - 1];
        const auto begin = std::ranges::find(segments, first, &reference::FibreSegment::who);
        const auto end = std::ranges::find(segments, last << 6U | (model::fibletSegments(set.heads[last]) - 1),
                                           &reference::FibreSegment::who);
        const glm::dvec3 way = glm::abs(glm::normalize(end->to - begin->from));
        for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(frame.pixels.rgba[4 * at + c], 255 * way[static_cast<int>(c)], 1.5);
    });
    layer().colour.mode = model::FibreColourMode::kPointColumn;
    layer().colour.component = 1;
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
}

/// The mean of 64 samples of lines at all slants is the area that a strip of their width covers of each pixel, to 1/10 of a
/// pixel, 1/40 on average; as they are drawn otherwise, oblique ones are thinner.
TEST_F(FibreFilters, CoverWhatTheirWidthSays) {
    Fibres fibres;
    for (int i = 0; i < 8; ++i) {
        const double angle = M_PI * (i + 0.3) / 8;
        std::vector<glm::vec3> line;
        for (int k = -60; k <= 60; ++k) {
            line.emplace_back(12 * (i % 4) - 18 + 0.05 * k * std::cos(angle), 12 * (i / 4) - 6 + 0.05 * k * std::sin(angle), 0);
        }
        fibres.add(line);
    }
    set = encodeFiblets(fibres.points, fibres.offsets, {});
    store.add("lines", set);
    segments = decodedSegments(set);
    request = fibreRequest("lines", 200, 120, 64);
    request.scene.light.irradiance = 0;
    request.scene.light.ambient = 1;
    layer().colour.mode = model::FibreColourMode::kUniform;
    layer().colour.uniform = glm::vec3(1);
    layer().line_width_px = 3;
    layer().exact_width = true;
    request.camera.eye_mm = {0, 0, 50};
    request.camera.up = {0, 1, 0};
    request.camera.height_mm = 30;
    const double pixel_mm = 30.0 / 120;
    const model::Frame frame = draw(request);
    double worst = 0, sum = 0;
    int count = 0;
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 200; ++x) {
            double covered = 0, least = 1e9;
            for (int s = 0; s < 256; ++s) {
                const glm::dvec2 p((x + (s % 16 + 0.5) / 16 - 100) * pixel_mm, (60 - y - (s / 16 + 0.5) / 16) * pixel_mm);
                bool in = false;
                for (int i = 0; i < 8; ++i) {
                    const double angle = M_PI * (i + 0.3) / 8;
                    const glm::dvec2 along(std::cos(angle), std::sin(angle)),
                        d = p - glm::dvec2(12 * (i % 4) - 18, 12 * (i / 4) - 6);
                    // Ends are cut along a row or column, not across.
                    least = std::min(least, std::abs(std::abs(glm::dot(d, along)) - 3));
                    in = in || (std::abs(glm::dot(d, along)) < 3 && std::abs(d.x * along.y - d.y * along.x) < 1.5 * pixel_mm);
                }
                covered += in / 256.0;
            }
            if (least < 3 * pixel_mm) continue;
            const double shown =
                reference::linearFromSrgb(frame.pixels.rgba[4 * static_cast<std::size_t>(y * 200 + x)] / 255.0);
            if (covered == 0 && shown == 0) continue;
            worst = std::max(worst, std::abs(shown - covered));
            sum += std::abs(shown - covered);
            ++count;
        }
    }
    EXPECT_GT(count, 200);
    EXPECT_LT(worst, 0.1);
    EXPECT_LT(sum / count, 0.025);
}

/// Selections, cuts and colours that another thread makes while this one draws: pictures are those of what the render thread
/// makes itself, and what is kept is found.
TEST_F(FibreFilters, AreMadeBesideTheRenderThread) {
    const model::FrameRequest drawn = request;
    const auto wanted = [&](int i) {
        model::FrameRequest one = drawn;
        model::TractogramLayer& fibres = one.scene.layers[0].tracts();
        fibres.shown.selection = "any sphere(" + std::to_string(i - 10) + ", 0, 0, 8)";
        if (i % 2 == 0) fibres.region_cuts.push_back({.region = "sphere(0, 0, 0, " + std::to_string(5 + i) + ")"});
        if (i % 3 == 0) fibres.colour.mode = model::FibreColourMode::kLength;
        return one;
    };
    std::vector<model::Frame> own;
    for (int i = 0; i < 4; ++i) own.push_back(draw(wanted(i)));
    EXPECT_TRUE(renderer.holdsFibres(wanted(3)));
    const model::Frame all = draw(drawn);
    std::atomic<bool> done = false;
    std::thread other([&] {
        for (int i = 23; i >= 0; --i) renderer.bringFibres(wanted(i));
        done = true;
    });
    int others = 0;
    do {
        others += draw(drawn).pixels.rgba != all.pixels.rgba;
    } while (!done);
    other.join();
    EXPECT_EQ(others, 0);
    EXPECT_FALSE(renderer.holdsFibres(wanted(23))) << "others took its place";
    for (int i = 0; i < 4; ++i) {
        EXPECT_TRUE(renderer.holdsFibres(wanted(i))) << i;
        const model::Frame brought = draw(wanted(i));
        EXPECT_EQ(brought.pixels.id, own[static_cast<std::size_t>(i)].pixels.id) << i;
        EXPECT_EQ(brought.pixels.rgba, own[static_cast<std::size_t>(i)].pixels.rgba) << i;
    }
}

}  // namespace
}  // namespace radiata::test
