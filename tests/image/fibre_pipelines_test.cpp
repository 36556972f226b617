// Every way to draw fibres shows the same ones as the compute shader, up to how lines are put on pixels.
#include <array>
#include <cstdlib>
#include <iostream>

#include "image/fibre_scenes.h"
#include "image/fixture.h"

namespace radiata::test {
namespace {

using Pipeline = model::FibletPipeline;
constexpr std::array kByRasteriser{Pipeline::kPull,     Pipeline::kMesh,         Pipeline::kMeshSerial,
                                   Pipeline::kGeometry, Pipeline::kTessellation, Pipeline::kLines};

struct Differences {
    int shown = 0;     ///< pixels of either picture
    int fibre = 0;     ///< that show another fibre, or only one of the two something
    int point = 0;     ///< of the same fibre, but more than one point off
    double depth = 0;  ///< largest, mm, where the segment is the same
};

Differences differences(const model::FramePixels& a, const model::FramePixels& b) {
    Differences found;
    for (std::size_t at = 0; at < a.depth.size(); ++at) {
        const std::int32_t *one = &a.id[4 * at], *other = &b.id[4 * at];
        if (one[0] < 0 && other[0] < 0) continue;
        ++found.shown;
        if (one[0] != other[0] || one[1] != other[1]) {
            ++found.fibre;
        } else if (std::abs(one[2] - other[2]) > 1) {
            ++found.point;
        } else if (one[2] == other[2]) {
            found.depth = std::max(found.depth, std::abs(double{a.depth[at]} - double{b.depth[at]}));
        }
    }
    return found;
}

class FibrePipelines : public ImageTest {};

TEST_F(FibrePipelines, ShowTheSameFibres) {
    const glm::dvec3 centre(13, -40, 22);
    store.add("fibres", randomTractogram(7, 40, 200, 0.4, 15, centre));
    model::FrameRequest request = fibreRequest("fibres", 160, 120);
    request.camera.target_mm = centre;
    request.camera.eye_mm = centre + glm::dvec3(60, -50, 70);
    for (int view = 0; view < 6; ++view) {
        request.camera.perspective = view % 2 == 1;
        request.camera.height_mm = view < 4 ? 50 : 6;
        request.camera.field_of_view_deg = view < 4 ? 30 : 4;
        model::TractogramLayer& layer = request.scene.layers[0].tracts();
        layer.line_width_px = view == 2 ? 3 : 1;
        layer.cuts.clear();
        if (view == 3) layer.cuts = {{centre, {1, 0.3, 0}}, {centre + glm::dvec3(0, 0, 3), {0, 0, 1}}};
        request.quality.fiblet_pipeline = Pipeline::kAtomic;
        const model::Frame atomic = draw(request);
        request.quality.fiblet_pipeline = Pipeline::kPull;
        const model::Frame pull = draw(request);
        for (const Pipeline pipeline : kByRasteriser) {
            request.quality.fiblet_pipeline = pipeline;
            const model::Frame frame = draw(request);
            const Differences d = differences(frame.pixels, atomic.pixels), e = differences(frame.pixels, pull.pixels);
            std::cout << view << " " << model::pipelineName(pipeline) << ": shown " << d.shown << " fibre " << d.fibre
                      << " point " << d.point << " depth " << d.depth << "; pull: " << e.fibre << " " << e.point << " "
                      << e.depth << "\n";
        }
        request.quality.fiblet_pipeline = Pipeline::kPoints;
        const Differences d = differences(draw(request).pixels, atomic.pixels);
        std::cout << view << " points: shown " << d.shown << " fibre " << d.fibre << " point " << d.point << " depth "
                  << d.depth << "\n";
    }
}

}  // namespace
}  // namespace radiata::test
