// The marks say where the patient's left is, whatever way the camera turns, and name what the picture leaves out.
#include "plan/annotations.h"

#include <string>

#include <gmock/gmock.h>

namespace radiata::plan {
namespace {

using ::testing::IsEmpty;

model::FrameRequest request(const glm::dvec3& eye, const glm::dvec3& up) {
    model::FrameRequest frame;
    frame.scene.layers.emplace_back();
    frame.camera.eye_mm = eye;
    frame.camera.up = up;
    return frame;
}

/// Text of the mark at an anchor and line.
std::string at(const std::vector<model::Mark>& marks, float x, float y, int line = 0) {
    for (const model::Mark& mark : marks) {
        if (mark.x == x && mark.y == y && mark.line == line) return mark.text;
    }
    return {};
}

TEST(Annotations, AxialFromTheFeetIsRadiological) {
    const auto marks = annotations(request({0, 0, -100}, {0, 1, 0}), model::FrameState::kConverged, 16, {10, 10});
    EXPECT_EQ(at(marks, 0, 0.5F), "R");
    EXPECT_EQ(at(marks, 1, 0.5F), "L");
    EXPECT_EQ(at(marks, 0.5F, 0), "A");
    EXPECT_EQ(at(marks, 0.5F, 1), "P");
    EXPECT_EQ(at(marks, 0, 1), "radiological: patient's left on the right");
    EXPECT_EQ(at(marks, 1, 1), "not for diagnostic use");
    EXPECT_EQ(at(marks, 0, 0), "converged");
    EXPECT_EQ(at(marks, 0, 0, 1), "negative lobes hidden");
    EXPECT_EQ(at(marks, 0, 0, 2), "");
}

TEST(Annotations, NameWhatIsLeftOutOfLayers) {
    auto frame = request({0, 0, -100}, {0, 1, 0});
    SubsetFacts facts{0, 10};
    facts.left_out = {{0, 4, 8, 37, 10, 1}};
    auto marks = annotations(frame, model::FrameState::kConverged, 16, facts);
    EXPECT_EQ(at(marks, 0, 0, 2), "subset: 0 of 10 glyphs shown");
    EXPECT_EQ(at(marks, 0, 0, 3), "bands to 4 of 8 drawn");
    EXPECT_EQ(at(marks, 0, 0, 4), "10 glyphs left out: too large or small for float32");
    EXPECT_EQ(at(marks, 0, 0, 5), "37 voxels left out: NaN or infinity");
    EXPECT_EQ(at(marks, 0, 0, 6), "1 glyph left out: no lobe to show");
    frame.scene.layers.emplace_back();
    facts.left_out = {{1, 8, 8, 1, 0, 0}};
    marks = annotations(frame, model::FrameState::kConverged, 16, facts);
    EXPECT_EQ(at(marks, 0, 0, 3), "layer 1: 1 voxel left out: NaN or infinity");
    EXPECT_EQ(at(marks, 0, 0, 4), "");
}

TEST(Annotations, NeverCallASubsetOfFibresConvergedWithoutThatWord) {
    auto frame = request({0, 0, -100}, {0, 1, 0});
    frame.scene.layers[0].content = model::TractogramLayer{};
    SubsetFacts facts;
    facts.left_out = {{.fiblet_pages = 1321, .fiblet_pages_left_out = 1226}};
    auto marks = annotations(frame, model::FrameState::kConverged, 16, facts);
    EXPECT_EQ(at(marks, 0, 0), "converged subset");
    EXPECT_EQ(at(marks, 0, 0, 1), "subset of fibres in 1226 of 1321 pages: beyond the memory for fibres");
    facts.left_out = {{.global_light = true}};
    marks = annotations(frame, model::FrameState::kConverged, 16, facts);
    EXPECT_EQ(at(marks, 0, 0), "converged");
    EXPECT_EQ(at(marks, 0, 0, 1), "no global light: only opaque isosurfaces without a shading of their own take it");
}

TEST(Annotations, AxialFromAboveContradictsTheRadiologicalSetting) {
    auto frame = request({0, 0, 100}, {0, 1, 0});
    auto marks = annotations(frame, model::FrameState::kInteractive, 1, {});
    EXPECT_EQ(at(marks, 0, 0.5F), "L");
    EXPECT_EQ(at(marks, 0, 1), "not radiological: patient's left on the left");
    frame.scene.annotations.convention = model::Convention::kNeurological;
    marks = annotations(frame, model::FrameState::kInteractive, 1, {});
    EXPECT_EQ(at(marks, 0, 1), "neurological: patient's left on the left");
}

TEST(Annotations, SagittalViewClaimsNothingAboutLeft) {
    const auto marks = annotations(request({-100, 0, 0}, {0, 0, 1}), model::FrameState::kRefining, 4, {});
    EXPECT_EQ(at(marks, 0, 0.5F), "A");
    EXPECT_EQ(at(marks, 1, 0.5F), "P");
    EXPECT_EQ(at(marks, 0.5F, 0), "S");
    EXPECT_EQ(at(marks, 0.5F, 1), "I");
    EXPECT_EQ(at(marks, 0, 1), "radiological");
    EXPECT_EQ(at(marks, 0, 0), "refining 4 of 16");
}

TEST(Annotations, ObliqueDirectionsGetASecondLetter) {
    EXPECT_EQ(orientationLetters(glm::normalize(glm::dvec3(-2, 1, 0))), "LA");
    EXPECT_EQ(orientationLetters(glm::normalize(glm::dvec3(0, 1, -2))), "IA");
    EXPECT_EQ(orientationLetters(glm::normalize(glm::dvec3(-10, 1, 0))), "L");
    EXPECT_EQ(orientationLetters({0, 0, 1}), "S");
}

TEST(Annotations, NamesSubsetAndLobes) {
    auto frame = request({0, 0, -100}, {0, 1, 0});
    frame.scene.layers[0].glyphs().selection.region = model::Region::kSlice;
    frame.scene.layers[0].glyphs().negative_lobes = model::NegativeLobes::kShown;
    const auto marks = annotations(frame, model::FrameState::kConverged, 16, {7216, 90000});
    EXPECT_EQ(at(marks, 0, 0, 1), "negative lobes shown");
    EXPECT_EQ(at(marks, 0, 0, 2), "slice: 7216 of 90000 glyphs shown");
}

TEST(Annotations, EveryColourMapHasItsLegend) {
    model::FrameRequest frame = request({0, 0, -100}, {0, 1, 0});
    EXPECT_THAT(colourBars(frame), IsEmpty());
    frame.scene.layers.resize(4, frame.scene.layers[0]);
    model::GlyphColour& radius = frame.scene.layers[1].glyphs().colour;
    radius.mode = model::ColourMode::kRadius;
    radius.range = model::ColourRange{0, 1.25F};
    frame.scene.layers[2] = frame.scene.layers[1];  // the same legend again
    model::GlyphColour& scalar = frame.scene.layers[3].glyphs().colour;
    scalar.mode = model::ColourMode::kScalar;
    scalar.map = ColourMap::kGrey;
    scalar.image_id = "fa";
    scalar.range = model::ColourRange{-1234.56F, 1e-5F};
    const std::vector<model::ColourBar> expected = {{ColourMap::kViridis, "radius, mm", "0", "1.25"},
                                                    {ColourMap::kGrey, "fa", "-1235", "1e-05"}};
    EXPECT_EQ(colourBars(frame), expected);
    frame.scene.annotations.hidden = true;
    EXPECT_THAT(colourBars(frame), IsEmpty());
}

TEST(Annotations, ColourMapsOfFibresAndSurfacesHaveLegends) {
    model::FrameRequest frame = request({0, 0, -100}, {0, 1, 0});
    const auto barsOf = [&](const model::FibreColour& colour) {
        model::TractogramLayer tracts;
        tracts.colour = colour;
        frame.scene.layers[0].content = tracts;
        return colourBars(frame);
    };
    using Mode = model::FibreColourMode;
    const model::FibreColourRange range{10, 180.5F};
    const auto named = [](const char* title) {
        return std::vector<model::ColourBar>{{ColourMap::kInferno, title, "10", "180.5"}};
    };
    model::FibreColour colour{.mode = Mode::kLength, .map = ColourMap::kInferno, .range = range, .column = "", .region = ""};
    EXPECT_EQ(barsOf(colour), named("length, mm"));
    colour.mode = Mode::kDistance;
    EXPECT_EQ(barsOf(colour), named("distance, mm"));
    colour.column = "fa";
    colour.mode = Mode::kColumn;
    EXPECT_EQ(barsOf(colour), named("fa"));
    colour.mode = Mode::kPointColumn;
    EXPECT_EQ(barsOf(colour), named("fa"));
    colour.component = 2;
    EXPECT_EQ(barsOf(colour), named("fa:2"));
    colour.mode = Mode::kGroup;
    EXPECT_THAT(barsOf(colour), IsEmpty());
    model::IsosurfaceLayer surface{.dataset_id = "t1", .isovalue = 50.0F};
    frame.scene.layers[0].content = surface;
    EXPECT_THAT(colourBars(frame), IsEmpty());
    surface.colour_by = model::VolumeColour{"bold", ColourMap::kInferno, model::ColourRange{10, 180.5F}};
    frame.scene.layers[0].content = surface;
    EXPECT_EQ(colourBars(frame), named("bold"));
}

TEST(Annotations, HiddenLeavesAllOut) {
    auto frame = request({0, 0, -100}, {0, 1, 0});
    frame.scene.annotations.hidden = true;
    EXPECT_THAT(annotations(frame, model::FrameState::kConverged, 16, {1, 2}), IsEmpty());
}

}  // namespace
}  // namespace radiata::plan
