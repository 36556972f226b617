// Transparent layers of all kinds in one picture, against the composition, in double and by depth, of what each shows alone.
#include <cmath>
#include <vector>

#include "build/folded_ball.h"
#include "image/fibre_scenes.h"
#include "image/fixture.h"
#include "reference/camera_rays.h"
#include "reference/capsule.h"
#include "reference/scalar_field.h"
#include "reference/shading.h"

namespace radiata::test {
namespace {

constexpr float kIso = 30;
constexpr int kWidth = 64, kHeight = 48;

/// What a pixel shows at a depth from the eye, mm.
struct Sheet {
    double depth = 0, opacity = 1;
    glm::dvec3 colour{0};
};
using Sheets = std::vector<std::vector<Sheet>>;  // of each pixel

class Transparency : public ImageTest {
protected:
    void SetUp() override {
        store.add("ball", ball_);
        store.add("glyphs", field_);
        store.add("some", some_);
        store.add("others", others_);
        base_ = fibreRequest("some", kWidth, kHeight);
        base_.scene.layers.clear();
        base_.scene.light.irradiance = 0;
        base_.scene.light.ambient = 1;  // every surface shows its base colour
        base_.scene.background = {0.2F, 0.2F, 0.2F};
        base_.camera.eye_mm = {20, -30, 25};
        base_.camera.target_mm = {0, 0, 0};
        base_.camera.perspective = false;
        base_.camera.height_mm = 20;
    }

    static model::Layer fibres(const std::string& dataset, const glm::vec3& colour, float opacity) {
        model::TractogramLayer layer;
        layer.dataset_id = dataset;
        layer.colour.mode = model::FibreColourMode::kUniform;
        layer.colour.uniform = colour;
        model::Layer result;
        result.content = layer;
        result.opacity = opacity;
        return result;
    }
    static model::Layer surface(float isovalue, const glm::vec3& colour, float opacity) {
        model::Layer result;
        result.content = model::IsosurfaceLayer{.dataset_id = "ball", .isovalue = isovalue, .colour = colour};
        result.opacity = opacity;
        return result;
    }
    static model::Layer glyphs(const glm::vec3& colour, float opacity) {
        model::Layer result = requestOf("glyphs", kWidth, kHeight, 2.5F).scene.layers[0];
        result.glyphs().colour.mode = model::ColourMode::kUniform;
        result.glyphs().colour.uniform = colour;
        result.opacity = opacity;
        return result;
    }

    model::FrameRequest sceneOf(const std::vector<model::Layer>& layers) const {
        model::FrameRequest request = base_;
        request.scene.layers = layers;
        return request;
    }

    /// The nearest of a layer drawn alone and opaque.
    void addNearest(model::Layer layer, Sheets& sheets) {
        const double opacity = static_cast<double>(std::exchange(layer.opacity, 1.0F));
        const model::Frame frame = draw(sceneOf({layer}));
        for (std::size_t at = 0; at < sheets.size(); ++at) {
            if (frame.pixels.id[4 * at] < 0) continue;
            glm::dvec3 colour;
            for (std::size_t c = 0; c < 3; ++c)
                colour[static_cast<int>(c)] = reference::linearFromSrgb(frame.pixels.rgba[4 * at + c] / 255.0);
            sheets[at].push_back({static_cast<double>(frame.pixels.depth[at]) + frame.info.depth_offset_mm, opacity, colour});
        }
    }
    /// Each fibre once.
    void addFibres(const model::Layer& layer, std::uint64_t count, Sheets& sheets) {
        for (std::uint32_t f = 0; f < count; ++f) {
            model::Layer one = layer;
            one.tracts().shown.fibres = {f};
            addNearest(one, sheets);
        }
    }
    /// All crossings, by the reference.
    void addCrossings(const model::Layer& layer, Sheets& sheets) {
        const reference::ScalarField volume(ball_);
        const glm::dmat4 to_grid = glm::inverse(ball_.voxel_to_world);
        for (std::size_t at = 0; at < sheets.size(); ++at) {
            const reference::Ray ray =
                reference::cameraRay(base_.camera, kWidth, kHeight, static_cast<double>(at % kWidth) + 0.5,
                                     static_cast<double>(at / kWidth) + 0.5);  // NOLINT: the row
            const glm::dvec3 origin(to_grid * glm::dvec4(ray.origin, 1)), direction = glm::dmat3(to_grid) * ray.direction;
            double t = 0;
            while (const auto hit =
                       volume.firstHit(origin, direction, static_cast<double>(*layer.surface().isovalue), t, 1e6)) {
                sheets[at].push_back({hit->t, static_cast<double>(layer.opacity), glm::dvec3(layer.surface().colour)});
                t = hit->t + 1e-3;
            }
        }
    }
    /// Where rays enter what is within a radius of a fibre: of its capsules the intervals that none before reaches into.
    void addTubes(const model::Layer& layer, const model::FibletSet& set, Sheets& sheets) const {
        const double radius = static_cast<double>(*layer.tracts().tube_radius_mm);
        const std::vector<reference::FibreSegment> segments = decodedSegments(set);
        for (std::size_t at = 0; at < sheets.size(); ++at) {
            const reference::Ray ray =
                reference::cameraRay(base_.camera, kWidth, kHeight, static_cast<double>(at % kWidth) + 0.5,
                                     static_cast<double>(at / kWidth) + 0.5);  // NOLINT: the row
            std::vector<std::vector<std::pair<double, double>>> inside(set.fibres());
            for (const reference::FibreSegment& segment : segments) {
                const glm::dvec3 along = segment.to - segment.from;
                const double middle = glm::dot(segment.from + 0.5 * along - ray.origin, ray.direction);
                const glm::dvec3 nearest = ray.origin + middle * ray.direction;
                const double away = 2 * radius + glm::length(along);
                if (2 * glm::distance(nearest, segment.from + 0.5 * along) > away) continue;
                const auto hit = [&](double from, double way) {
                    return reference::capsuleHit(nearest + from * ray.direction, way * ray.direction, segment.from, along,
                                                 radius, 0);
                };
                const reference::CapsuleHit enters = hit(-away, 1), leaves = hit(away, -1);
                if (!enters.hit || !leaves.hit) continue;
                inside[set.heads[segment.who >> 6U].fibre].emplace_back(middle - away + enters.t, middle + away - leaves.t);
            }
            for (auto& intervals : inside) {
                std::ranges::sort(intervals);
                double end = -1e30;
                for (const auto& [from, to] : intervals) {
                    if (from > end)
                        sheets[at].push_back(
                            {from, static_cast<double>(layer.opacity), glm::dvec3(layer.tracts().colour.uniform)});
                    end = std::max(end, to);
                }
            }
        }
    }
    /// How many pixels of those with at least `least` sheets, and how many of them are as composed, to 0.012 of linear light.
    std::pair<int, int> compare(const model::Frame& frame, Sheets sheets, std::size_t least) const {
        int several = 0, equal = 0;
        for (std::size_t at = 0; at < sheets.size(); ++at) {
            std::ranges::sort(sheets[at], {}, &Sheet::depth);
            if (sheets[at].size() < least) continue;
            glm::dvec3 expected(0);
            double through = 1;
            for (const Sheet& sheet : sheets[at]) {
                expected += through * sheet.opacity * sheet.colour;
                through *= 1 - sheet.opacity;
            }
            expected += through * glm::dvec3(base_.scene.background);
            double off = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                off = std::max(off, std::abs(expected[static_cast<int>(c)] -
                                             reference::linearFromSrgb(frame.pixels.rgba[4 * at + c] / 255.0)));
            }
            ++several;
            equal += off < 0.012;
        }
        return {several, equal};
    }

    model::ScalarImage ball_ = foldedBall(20);
    model::ShImage field_ =
        randomField({4, false}, {3, 3, 2}, 51, glm::dmat4(4, 0, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0, -4, -4, -2, 1));
    model::FibletSet some_ = randomTractogram(41, 12, 120, 0.4, 5), others_ = randomTractogram(42, 12, 120, 0.4, 5);
    model::FrameRequest base_;
};

/// Fibres of two layers, an isosurface with folds, and glyphs, over an opaque lump. Nine of ten pixels, as fibres may cross
/// themselves and silhouettes are thin.
TEST_F(Transparency, ComposesLayersOfAllKindsByDepth) {
    const std::vector<model::Layer> layers{fibres("some", {1, 0, 0}, 0.4F), surface(kIso, {0, 1, 0}, 0.3F),
                                           glyphs({0, 0, 1}, 0.5F), fibres("others", {1, 1, 0}, 0.6F),
                                           surface(75, {1, 1, 1}, 1)};
    Sheets sheets(kWidth * kHeight);
    addFibres(layers[0], some_.fibres(), sheets);
    addCrossings(layers[1], sheets);
    addNearest(layers[2], sheets);
    addFibres(layers[3], others_.fibres(), sheets);
    addNearest(layers[4], sheets);
    const model::Frame frame = draw(sceneOf(layers));
    const auto [several, equal] = compare(frame, sheets, 4);
    std::printf("%d pixels of four surfaces and more, %d as composed\n", several, equal);
    EXPECT_GT(several, 400);
    EXPECT_GT(equal, several * 9 / 10);
    const auto [covered, all_equal] = compare(frame, sheets, 1);
    EXPECT_GT(covered, 1000);
    EXPECT_GT(all_equal, covered * 9 / 10);
    // The order of the layers is nothing to the picture.
    const std::vector<model::Layer> reversed(layers.rbegin(), layers.rend());
    const model::Frame again = draw(sceneOf(reversed));
    int other = 0;
    for (std::size_t i = 0; i < frame.pixels.rgba.size(); ++i)
        other += std::abs(frame.pixels.rgba[i] - again.pixels.rgba[i]) > 1;
    EXPECT_LT(other, 20);
    // Who is seen is what is opaque, here the lump.
    for (std::size_t at = 0; at < sheets.size(); ++at) {
        ASSERT_TRUE(frame.pixels.id[4 * at] == 4 || frame.pixels.id[4 * at] == -1);
    }
    EXPECT_EQ(frame.info.hit_pixels, static_cast<std::uint64_t>(std::ranges::count_if(
                                         frame.pixels.depth, [](float depth) { return std::isfinite(depth); })));
}

/// Tubes of two layers that run into each other, and an isosurface and glyphs among them, over an opaque lump: many more
/// surfaces than a pixel keeps of a layer at once. Within a fibre's own bends one surface may count for two.
TEST_F(Transparency, ComposesManyTubes) {
    const model::FibletSet many = randomTractogram(43, 150, 200, 0.25, 4), more = randomTractogram(44, 80, 200, 0.25, 4);
    store.add("many", many);
    store.add("more", more);
    std::vector<model::Layer> layers{fibres("many", {1, 0, 0}, 0.2F), surface(kIso, {0, 1, 0}, 0.3F), glyphs({0, 0, 1}, 0.3F),
                                     fibres("more", {1, 1, 0}, 0.15F), surface(75, {1, 1, 1}, 1)};
    for (const std::size_t i : {std::size_t{0}, std::size_t{3}}) layers[i].tracts().tube_radius_mm = 0.5F;
    const auto check = [&](const std::vector<model::Layer>& shown, std::size_t deep) {
        Sheets sheets(kWidth * kHeight);
        for (const model::Layer& layer : shown) {
            if (layer.ifTracts()) addTubes(layer, layer.datasetId() == "many" ? many : more, sheets);
            if (layer.ifSurface() && layer.opacity < 1) addCrossings(layer, sheets);
            if (layer.ifGlyphs() || layer.opacity >= 1) addNearest(layer, sheets);
        }
        const model::Frame frame = draw(sceneOf(shown));
        const auto [several, equal] = compare(frame, sheets, deep);
        const auto [covered, all_equal] = compare(frame, sheets, 1);
        std::printf("%d of %d pixels of %zu surfaces and more as composed, %d of %d of any\n", equal, several, deep, all_equal,
                    covered);
        EXPECT_GT(several, 150);
        EXPECT_GT(equal, several * 94 / 100);
        EXPECT_GT(all_equal, covered * 97 / 100);
        return frame;
    };
    const model::Frame tubes = check({layers[0]}, 10);
    EXPECT_EQ(draw(sceneOf({layers[0]})).pixels.rgba, tubes.pixels.rgba);
    check(layers, 20);
}

/// Half-opaque glyphs show fibres and surfaces behind them, not the background.
TEST_F(Transparency, OfGlyphsShowsWhatIsBehind) {
    const std::vector<model::Layer> layers{glyphs({0, 0, 1}, 0.5F), fibres("some", {1, 0, 0}, 1), surface(60, {0, 1, 0}, 1)};
    const model::Frame frame = draw(sceneOf(layers));
    Sheets sheets(kWidth * kHeight);
    for (const model::Layer& layer : layers) addNearest(layer, sheets);
    const auto [several, equal] = compare(frame, sheets, 2);
    EXPECT_GT(several, 120);
    EXPECT_GE(equal, several - several / 100);
    // Picks find the glyphs all the same.
    int picked = 0;
    for (std::size_t at = 0; at < sheets.size() && picked < 5; at += 17) {
        std::ranges::sort(sheets[at], {}, &Sheet::depth);
        if (sheets[at].empty() || sheets[at][0].colour.z < 0.5) continue;
        const auto found = renderer.pick(sceneOf(layers), static_cast<int>(at % kWidth), static_cast<int>(at / kWidth));
        ASSERT_TRUE(found.has_value());
        EXPECT_TRUE(std::holds_alternative<model::PickedGlyph>(*found));
        ++picked;
    }
    EXPECT_EQ(picked, 5);
}

/// Picks go through half-opaque surfaces to what lies behind; where nothing does, the nearest of them is picked.
TEST_F(Transparency, OfSurfacesIsPickedWhereNothingLiesBehind) {
    const std::vector<model::Layer> layers{surface(kIso, {0, 1, 0}, 0.3F), fibres("some", {1, 0, 0}, 1)};
    const std::vector<model::Layer> opaque{surface(kIso, {0, 1, 0}, 1)};
    const model::Frame whole = draw(sceneOf(layers)), shell = draw(sceneOf(opaque));
    int through = 0, met = 0, nothing = 0;
    for (std::size_t at = 0; at < static_cast<std::size_t>(kWidth * kHeight); at += 13) {
        const auto found = renderer.pick(sceneOf(layers), static_cast<int>(at % kWidth), static_cast<int>(at / kWidth));
        const bool fibre = whole.pixels.id[4 * at] >= 0, hull = shell.pixels.id[4 * at] >= 0;
        ASSERT_EQ(found.has_value(), fibre || hull);
        if (!found) {
            ++nothing;
        } else if (fibre) {
            ASSERT_TRUE(std::holds_alternative<model::PickedFibre>(*found));
            ++through;
        } else {
            const auto& picked = std::get<model::PickedSurface>(*found);
            EXPECT_EQ(picked.layer, 0);
            EXPECT_NEAR(picked.normal.x, shell.pixels.normal[3 * at], 1e-4);
            ++met;
        }
    }
    EXPECT_GT(std::min({through, met, nothing}), 5);
}

/// White sheets over black: while the picture moves, what shines through is right, to 0.01 in nine of ten pixels, though not
/// who is seen; at rest it is the same however its samples were split. What is opaque has none of the passes.
TEST_F(Transparency, ComesToRest) {
    base_.scene.background = glm::vec3(0);
    const std::vector<model::Layer> layers{fibres("some", glm::vec3(1), 0.3F), surface(kIso, glm::vec3(1), 0.2F),
                                           glyphs(glm::vec3(1), 0.3F), fibres("others", glm::vec3(1), 0.3F)};
    model::FrameRequest request = sceneOf(layers);
    Sheets sheets(kWidth * kHeight);
    addFibres(layers[0], some_.fibres(), sheets);
    addCrossings(layers[1], sheets);
    addNearest(layers[2], sheets);
    addFibres(layers[3], others_.fibres(), sheets);
    request.quality.samples = 2;
    render::Target target;
    const auto [covered, equal] = compare(renderer.render(target, request, 0, 1), sheets, 1);
    EXPECT_GT(covered, 1000);
    EXPECT_GT(equal, covered * 8 / 10);
    EXPECT_EQ(renderer.render(target, request, 1, 1).pixels.rgba, draw(request).pixels.rgba);
    const auto peels = [](const model::Frame& frame) {
        return std::ranges::count_if(frame.info.passes,
                                     [](const auto& pass) { return pass.name.find("peel") != std::string::npos; });
    };
    request.quality.samples = 1;
    EXPECT_EQ(peels(draw(request)), 3) << "beginning, crossings, light";
    for (model::Layer& layer : request.scene.layers) layer.opacity = 1;
    EXPECT_EQ(peels(draw(request)), 0);
}

}  // namespace
}  // namespace radiata::test
