#include "plan/annotations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

namespace radiata::plan {
namespace {

using model::Mark;
using model::MarkAlign;

constexpr double kSecondLetter = 0.25;  // sine of the angle from which the second letter is written
constexpr float kLetterSize = 1.4F;

/// Short, as it has to stay clear of the letter beside it in small pictures too.
std::string stateText(model::FrameState state, int samples, int samples_wanted, const SubsetFacts& facts) {
    const bool part =
        std::ranges::any_of(facts.left_out, [](const model::LeftOut& left_out) { return left_out.fiblet_pages_left_out > 0; });
    if (state == model::FrameState::kConverged) return part ? "converged subset" : "converged";
    if (state == model::FrameState::kInteractive) return "interactive";
    return "refining " + std::to_string(samples) + " of " + std::to_string(samples_wanted);
}

/// Says where the patient's left is if the view shows it, and how that goes with the convention that was asked for.
std::string conventionText(model::Convention convention, const glm::dvec3& right) {
    const bool radiological = convention == model::Convention::kRadiological;
    const std::string name = radiological ? "radiological" : "neurological";
    const bool shows_left = std::abs(right.x) > std::abs(right.y) && std::abs(right.x) > std::abs(right.z);
    if (!shows_left) return name;
    const bool left_on_right = right.x < 0;
    const std::string fact = left_on_right ? "patient's left on the right" : "patient's left on the left";
    return (left_on_right == radiological ? name : "not " + name) + ": " + fact;
}

std::string lobesText(const model::Scene& scene) {
    std::size_t shown = 0, hidden = 0;
    for (const model::Layer& layer : scene.layers) {
        if (const model::GlyphLayer* glyphs = layer.ifGlyphs()) {
            ++(glyphs->negative_lobes == model::NegativeLobes::kShown ? shown : hidden);
        }
    }
    if (shown + hidden == 0) return {};
    if (hidden == 0) return "negative lobes shown";
    return shown == 0 ? "negative lobes hidden" : "negative lobes hidden in some layers";
}

std::string shortNumber(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", static_cast<double>(value));
    return text;
}

/// Empty if the picture leaves nothing out.
std::string subsetText(const model::Scene& scene, const SubsetFacts& facts) {
    if (facts.glyphs >= facts.glyphs_available) return {};
    std::string what = "subset";
    const auto all = [&scene](model::Region region) {
        return std::ranges::all_of(scene.layers, [region](const model::Layer& layer) {
            return !layer.ifGlyphs() || layer.glyphs().selection.region == region;
        });
    };
    if (all(model::Region::kSlice)) what = "slice";
    if (all(model::Region::kSlab)) what = "slab";
    return what + ": " + std::to_string(facts.glyphs) + " of " + std::to_string(facts.glyphs_available) + " glyphs shown";
}

/// Legend of a colour map with its ends. \param range  model::ColourRange, or that of fibres
template <typename Range>
model::ColourBar barOf(ColourMap map, const std::string& title, const Range& range) {
    return {map, title, shortNumber(range.low), shortNumber(range.high)};
}

std::optional<model::ColourBar> glyphBar(const model::GlyphColour& colour) {
    if (!colour.usesMap() || !colour.range) return {};
    return barOf(colour.map, colour.mode == model::ColourMode::kRadius ? "radius, mm" : colour.image_id, *colour.range);
}

std::optional<model::ColourBar> fibreBar(const model::FibreColour& colour) {
    if (!colour.usesMap() || !colour.range) return {};
    std::string title = colour.column;
    if (colour.mode == model::FibreColourMode::kLength) title = "length, mm";
    if (colour.mode == model::FibreColourMode::kDistance) title = "distance, mm";
    if (colour.mode == model::FibreColourMode::kPointColumn && colour.component > 0) {
        title += ":" + std::to_string(colour.component);
    }
    return barOf(colour.map, title, *colour.range);
}

std::optional<model::ColourBar> surfaceBar(const model::IsosurfaceLayer& surface) {
    if (!surface.colour_by || !surface.colour_by->range) return {};
    return barOf(surface.colour_by->map, surface.colour_by->image_id, *surface.colour_by->range);
}

Mark corner(std::string text, float x, float y, int line) {
    Mark mark;
    mark.text = std::move(text);
    mark.x = x;
    mark.y = y;
    mark.horizontal = x > 0.5F ? MarkAlign::kEnd : MarkAlign::kStart;
    mark.vertical = y > 0.5F ? MarkAlign::kEnd : MarkAlign::kStart;
    mark.line = line;
    return mark;
}

Mark edge(const glm::dvec3& direction, float x, float y, MarkAlign horizontal, MarkAlign vertical) {
    return {orientationLetters(direction), x, y, horizontal, vertical, 0, kLetterSize};
}

}  // namespace

std::string orientationLetters(const glm::dvec3& direction) {
    constexpr std::array<const char*, 3> kPositive = {"R", "A", "S"};
    constexpr std::array<const char*, 3> kNegative = {"L", "P", "I"};
    std::array<int, 3> order = {0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return std::abs(direction[a]) > std::abs(direction[b]); });
    const auto letter = [&](int axis) {
        return direction[axis] < 0 ? kNegative[static_cast<std::size_t>(axis)] : kPositive[static_cast<std::size_t>(axis)];
    };
    std::string letters = letter(order[0]);
    if (std::abs(direction[order[1]]) > kSecondLetter) letters += letter(order[1]);
    return letters;
}

std::vector<Mark> annotations(const model::FrameRequest& request, model::FrameState state, int samples,
                              const SubsetFacts& facts) {
    if (request.scene.annotations.hidden) return {};
    const model::CameraFrame axes = model::cameraFrame(request.camera);
    std::vector<Mark> marks = {
        edge(-axes.right, 0, 0.5F, MarkAlign::kStart, MarkAlign::kCenter),
        edge(axes.right, 1, 0.5F, MarkAlign::kEnd, MarkAlign::kCenter),
        edge(axes.up, 0.5F, 0, MarkAlign::kCenter, MarkAlign::kStart),
        edge(-axes.up, 0.5F, 1, MarkAlign::kCenter, MarkAlign::kEnd),
        corner("not for diagnostic use", 1, 1, 0),
        corner(stateText(state, samples, request.quality.samples, facts), 0, 0, 0),
        corner(conventionText(request.scene.annotations.convention, axes.right), 0, 1, 0),
    };
    std::vector<std::string> texts{lobesText(request.scene), subsetText(request.scene, facts)};
    for (const model::LeftOut& left_out : facts.left_out) {
        for (std::string& text : model::leftOutTexts(left_out, request.scene.layers.size() > 1))
            texts.push_back(std::move(text));
    }
    int line = 1;
    for (std::string& text : texts) {
        if (!text.empty()) marks.push_back(corner(std::move(text), 0, 0, line++));
    }
    return marks;
}

std::vector<model::ColourBar> colourBars(const model::FrameRequest& request) {
    std::vector<model::ColourBar> bars;
    if (request.scene.annotations.hidden) return bars;
    for (const model::Layer& layer : request.scene.layers) {
        const std::optional<model::ColourBar> bar = layer.ifGlyphs()    ? glyphBar(layer.glyphs().colour)
                                                    : layer.ifTracts()  ? fibreBar(layer.tracts().colour)
                                                    : layer.ifSurface() ? surfaceBar(layer.surface())
                                                                        : std::nullopt;
        if (bar && std::find(bars.begin(), bars.end(), *bar) == bars.end()) bars.push_back(*bar);
    }
    return bars;
}

}  // namespace radiata::plan
