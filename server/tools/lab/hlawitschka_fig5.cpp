// hlawitschka-fig5: the colour codings of Hlawitschka et al.'s figure (radius through black, red and yellow; absolute direction
// as RGB; one colour) and ours, on one slice: what each costs in the light pass, and whether each pixel has the colour that its
// glyph's surface should have, from the lossless outputs by the double-precision twin.
#include <algorithm>
#include <cmath>

#include "gpu/device.h"
#include "reference/colour_map.h"
#include "reference/shading.h"
#include "tools/lab/experiments.h"
#include "tools/lab/measure.h"
#include "tools/lab/scenes.h"

namespace radiata::lab {
namespace {

constexpr int kPaperSize = 1080, kReducedSize = 360;
constexpr double kBound = 1.5;  // steps of 8 bits: half a one for rounding, the rest where the transfer curve is steep

model::GlyphColour coding(model::ColourMode mode, ColourMap map = ColourMap::kViridis) {
    model::GlyphColour colour;
    colour.mode = mode;
    colour.map = map;
    colour.uniform = {0.6F, 0.6F, 0.2F};
    if (mode == model::ColourMode::kScalar) colour.image_id = "values";
    return colour;
}

/// A number for each voxel: the sum of its indices.
model::ScalarImage valuesOf(const model::ShImage& image) {
    model::ScalarImage values{image.size, image.voxel_to_world, {}, "sum of indices"};
    for (int k = 0; k < image.size.z; ++k) {
        for (int j = 0; j < image.size.y; ++j) {
            for (int i = 0; i < image.size.x; ++i) values.values.push_back(static_cast<float>(i + j + k));
        }
    }
    return values;
}

/// Linear RGB that a hit should have. \param offset  from the glyph's centre
glm::dvec3 expectedColour(const model::GlyphColour& colour, const glm::ivec3& voxel, const glm::dvec3& offset) {
    if (colour.mode == model::ColourMode::kUniform) return glm::dvec3(colour.uniform);
    if (colour.mode == model::ColourMode::kDirection) {
        const glm::dvec3 d = glm::abs(glm::normalize(offset));
        return {reference::linearFromSrgb(d.x), reference::linearFromSrgb(d.y), reference::linearFromSrgb(d.z)};
    }
    const double value = colour.mode == model::ColourMode::kRadius ? glm::length(offset) : voxel.x + voxel.y + voxel.z;
    return reference::mappedColour(linearColourTable(colour.map), value, colour.range->low, colour.range->high);
}

/// Largest difference of a channel from the twin over all hits, in steps of 8 bits, under constant light only.
double worstChannel(render::Renderer& renderer, const model::ShImage& image, model::FrameRequest request) {
    request.scene.light.irradiance = 0;
    request.scene.light.ambient = 1;
    model::Outputs outputs;
    outputs.id = outputs.position = true;
    const model::Frame frame = renderer.renderAll(request, outputs);
    const model::GlyphColour& colour = frame.info.request.scene.layers[0].glyphs().colour;
    double worst = 0;
    for (std::size_t at = 0; 4 * at < frame.pixels.id.size(); ++at) {
        if (frame.pixels.id[4 * at] < 0) continue;
        glm::ivec3 voxel;
        glm::dvec3 place = frame.info.position_origin_mm;
        for (std::size_t c = 0; c < 3; ++c) {
            const int axis = static_cast<int>(c);
            voxel[axis] = frame.pixels.id[4 * at + 1 + c];
            place[axis] += static_cast<double>(frame.pixels.position[3 * at + c]);
        }
        const glm::dvec3 centre(image.voxel_to_world * glm::dvec4(glm::dvec3(voxel), 1.0));
        // At the very centre a direction means nothing.
        if (glm::length(place - centre) < 1e-2) continue;
        const glm::dvec3 expected = expectedColour(colour, voxel, place - centre);
        for (std::size_t c = 0; c < 3; ++c) {
            const double shown = frame.pixels.rgba[4 * at + c];
            worst = std::max(worst, std::abs(shown - 255 * reference::srgbFromLinear(expected[static_cast<int>(c)])));
        }
    }
    return worst;
}

}  // namespace

Report hlawitschkaFig5(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "hlawitschka-fig5";
    report.repeats = options.rounds();
    const int height = pictureHeight(device, options, kPaperSize, kReducedSize), width = height * 16 / 9;
    report.view = std::to_string(width) + "x" + std::to_string(height) + ", orthographic";
    store::Store store(device, {});
    const model::ShImage image = slice(options, 4, 2000, report.scene);
    store.add("slice", image);
    store.add("values", valuesOf(image));
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    model::FrameRequest request = requestOf("slice", width, height, true);
    request.camera = renderer.fitCamera("slice", request.scene.layers[0].glyphs().selection, model::Convention::kRadiological,
                                        static_cast<double>(width) / height);
    const std::pair<const char*, model::GlyphColour> codings[] = {
        {"direction", coding(model::ColourMode::kDirection)},
        {"radius, black-red-yellow", coding(model::ColourMode::kRadius, ColourMap::kBlackRedYellow)},
        {"radius, viridis", coding(model::ColourMode::kRadius)},
        {"one colour", coding(model::ColourMode::kUniform)},
        {"scalar volume, viridis", coding(model::ColourMode::kScalar)},
    };
    std::vector<Candidate> candidates;
    for (const auto& [name, colour] : codings) {
        candidates.push_back({name, name, request});
        candidates.back().request.scene.layers[0].glyphs().colour = colour;
    }
    const std::vector<Measured> measured = measure(renderer, candidates, report.repeats, {"light"});
    Table table{
        "Colour codings: light pass, and difference from the twin", {"coding", "light ms", "frame ms", "worst, of 255"}, {}};
    Plot plot{"error of colours against time", "light pass, ms", "worst channel, of 255", false, false, false, {}};
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const double worst = worstChannel(renderer, image, candidates[i].request);
        table.rows.push_back({measured[i].name, shortNumber(measured[i].time.median()),
                              shortNumber(measured[i].frame_time.median()), shortNumber(worst)});
        plot.curves.push_back({measured[i].name, {{measured[i].time.median(), worst, measured[i].name}}, false});
        report.series.push_back(measured[i].time);
        report.checks.push_back({measured[i].name + ": worst channel, of 255", worst, "<=", kBound});
    }
    report.tables.push_back(table);
    report.plots.push_back(std::move(plot));
    report.notes.push_back("the paper's data are not at hand: a slice of the phantom is shown instead");
    noteShortfalls(report, height, kReducedSize);
    return report;
}

}  // namespace radiata::lab
