// schertzer-fig9: what the coverage scheme of Schertzer et al. 2022 (Sec. 3.4) leaves out wrongly. A view rests until its
// buffer has settled, then the camera turns by some angle, 60 degrees in the paper's figure, and rests again. A pixel is faulty
// if it shows somebody else than all fiblets together do; a fiblet is culled wrongly if it is seen in the picture of all and
// was not drawn.
#include <set>

#include "render/frame/renderer.h"
#include "store/store.h"
#include "tools/lab/experiments.h"
#include "tools/lab/statistics.h"
#include "tools/lab/tract_scenes.h"

namespace radiata::lab {
namespace {

constexpr std::size_t kFibres = 20'000;
constexpr int kHeight = 720, kSettlingFrames = 3, kFramesAfter = 3;
constexpr double kTurns[] = {0, 1.14, 5, 20, 60};

/// What one picture shows differently from the picture of all fiblets.
struct Faults {
    std::uint64_t pixels = 0, shown = 0, fibres = 0;
    double drawn = 0;
    bool operator==(const Faults&) const = default;
};

Faults compare(const model::Frame& all, const model::Frame& culled) {
    Faults faults;
    std::set<std::int32_t> seen, seen_culled;
    for (std::size_t at = 0; at < all.pixels.depth.size(); ++at) {
        const std::int32_t *a = &all.pixels.id[4 * at], *b = &culled.pixels.id[4 * at];
        faults.shown += a[0] >= 0;
        // One-line fiblets name segments by their share of the line: who is seen is a matter of the fibre.
        faults.pixels += a[0] != b[0] || a[1] != b[1];
        if (a[0] >= 0) seen.insert(a[1]);
        if (b[0] >= 0) seen_culled.insert(b[1]);
    }
    for (const std::int32_t fibre : seen) faults.fibres += !seen_culled.contains(fibre);
    faults.drawn = static_cast<double>(culled.info.fiblets_drawn) / static_cast<double>(culled.info.fiblets);
    return faults;
}

}  // namespace

Report schertzerFig9(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "schertzer-fig9";
    report.repeats = 1;
    report.scene = std::to_string(kFibres) + " generated fibres of 800 points, 0.1 mm apart, in a ball of 140 mm";
    store::Store store(device, {});
    store.add("fibres", ballOfFibres(kFibres));
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    const int height = pictureHeight(device, options, kHeight, kHeight);
    model::FrameRequest request = fibreFrame(height, "fibres");
    report.view = std::to_string(request.width) + "x" + std::to_string(request.height) + ", whole, perspective, one sample";
    model::Camera start =
        renderer.fitCamera("fibres", {}, model::Convention::kRadiological, static_cast<double>(request.width) / request.height);
    start.perspective = true;
    model::Outputs outputs;
    outputs.id = outputs.depth = true;
    const auto draw = [&](render::Target& target, model::FibletCulling culling) {
        request.quality.fiblet_culling = culling;
        return renderer.render(target, request, 0, 1, outputs);
    };
    Table table{"after a turn of the camera",
                {"degrees", "scheme", "frame", "faulty pixels", "of those shown, %", "fibres gone", "fiblets drawn, %"},
                {}};
    double still = 0, turned = 0, conservative = 0, recovered = 0;
    for (const double degrees : kTurns) {
        for (const auto& [name, culling] : {std::pair{"coverage", model::FibletCulling::kCoverage},
                                            std::pair{"two-phase", model::FibletCulling::kTwoPhase}}) {
            render::Target target, plain;
            request.camera = start;
            for (int i = 0; i < kSettlingFrames; ++i) draw(target, culling);
            request.camera = model::orbit(start, degrees, 0);
            const model::Frame all = draw(plain, model::FibletCulling::kNone);
            for (int frame = 1; frame <= kFramesAfter; ++frame) {
                const Faults faults = compare(all, draw(target, culling));
                const double share = 100 * static_cast<double>(faults.pixels) / static_cast<double>(faults.shown);
                table.rows.push_back({shortNumber(degrees), name, std::to_string(frame), std::to_string(faults.pixels),
                                      shortNumber(share), std::to_string(faults.fibres), shortNumber(100 * faults.drawn)});
                if (culling == model::FibletCulling::kTwoPhase) {
                    conservative += static_cast<double>(faults.pixels);
                } else if (frame == 1) {
                    (degrees == 0 ? still : turned) = share;
                } else if (frame == kFramesAfter) {
                    recovered = share;
                }
            }
        }
    }
    report.tables.push_back(table);
    report.checks.push_back({"faulty pixels of two-phase culling", conservative, "<=", 0});
    report.checks.push_back({"faulty pixels of coverage after 60 degrees against a camera at rest, %", turned, ">=", still});
    report.checks.push_back({"faulty pixels of coverage two frames later, %", recovered, "<=", turned});
    noteShortfalls(report, height, kHeight);
    report.shortfalls.clear();  // counts, not times: one round tells all
    return report;
}

}  // namespace radiata::lab
