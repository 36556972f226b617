// fiblet-scaling: how the time of a frame grows with the tractogram, culled and not: fibres of a whole brain's extent, seen
// whole at 1280 x 720, in a turn of 1.14 degrees a frame (the protocol of Schertzer et al. 2022, Table 2). Culled frames follow
// each other in one view, so that each knows what the one before showed.
#include <algorithm>

#include "gpu/device.h"
#include "store/store.h"
#include "tools/lab/experiments.h"
#include "tools/lab/measure.h"
#include "tools/lab/statistics.h"
#include "tools/lab/tract_scenes.h"

namespace radiata::lab {
namespace {

constexpr double kDegreesPerFrame = 1.14;
constexpr int kHeight = 720;

struct Size {
    std::size_t fibres;
    double bound;  ///< culled / unculled
};
constexpr Size kSizes[] = {{10'000, 0}, {100'000, 0.4}, {500'000, 0.2}};

std::string label(std::size_t fibres, const char* what) { return std::to_string(fibres) + " fibres, " + what; }

/// Everything that is measured of one size.
struct Scaling {
    std::uint64_t segments = 0, set_bytes = 0, device_bytes = 0, fiblets = 0, drawn = 0;
    Series culled, unculled;

    double ratio() const { return culled.median() / unculled.median(); }
};

Scaling measureSize(gpu::Device& device, const Size& size, Report& report, int height) {
    store::Store store(device, {});
    model::FibletSet set = ballOfFibres(size.fibres);
    Scaling result;
    result.segments = set.points - set.fibres();
    result.fiblets = set.heads.size();
    result.set_bytes = std::span(set.heads).size_bytes() + std::span(set.codes).size_bytes() +
                       std::span(set.boxes).size_bytes() + std::span(set.pages).size_bytes();
    store.add("fibres", std::move(set));
    render::Renderer renderer(device, store);
    report.device = renderer.deviceName();
    const std::uint64_t before = device.allocatedBytes();
    model::FrameRequest request = fibreFrame(height, "fibres");
    const model::Camera start =
        renderer.fitCamera("fibres", {}, model::Convention::kRadiological, static_cast<double>(request.width) / request.height);
    render::Target target;
    result.culled = {label(size.fibres, "culled, wall clock"), "ms", {}};
    result.unculled = {label(size.fibres, "unculled, wall clock"), "ms", {}};
    int frame = 0;
    const auto draw = [&](model::FibletCulling culling) {
        request.quality.fiblet_culling = culling;
        render::Target fresh;
        return renderer.render(culling == model::FibletCulling::kNone ? fresh : target, request, 0, 1).info;
    };
    interleave(report.repeats, {[&] {
                   request.camera = model::orbit(start, kDegreesPerFrame * frame++, 0);
                   const model::FrameInfo info = draw(model::FibletCulling::kTwoPhase);
                   result.device_bytes = device.allocatedBytes() - before;
                   result.drawn = info.fiblets_drawn;
                   result.culled.values.push_back(info.render_ms);
                   result.unculled.values.push_back(draw(model::FibletCulling::kNone).render_ms);
               }});
    // The first is the warm-up, which knows no picture before.
    result.culled.values.erase(result.culled.values.begin());
    result.unculled.values.erase(result.unculled.values.begin());
    return result;
}

}  // namespace

Report fibletScaling(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "fiblet-scaling";
    report.repeats = options.rounds();
    report.scene = "generated fibres of 800 points, 0.1 mm apart, in a ball of 140 mm";
    const int height = pictureHeight(device, options, kHeight, kHeight);
    report.view = std::to_string(height * 16 / 9) + "x" + std::to_string(height) + ", whole, one sample, lines lit";
    Table table{"segments and bytes",
                {"fibres", "million segments", "bytes a point", "device MB in all", "fiblets drawn, %", "culled / unculled",
                 "million segments a second"},
                {}};
    std::vector<Scaling> all;
    for (const Size& size : kSizes) {
        all.push_back(measureSize(device, size, report, height));
        const Scaling& one = all.back();
        const auto segments = static_cast<double>(one.segments);
        table.rows.push_back({std::to_string(size.fibres), shortNumber(segments * 1e-6),
                              shortNumber(static_cast<double>(one.set_bytes) / (segments + static_cast<double>(size.fibres))),
                              shortNumber(static_cast<double>(one.device_bytes) * 1e-6),
                              shortNumber(100 * static_cast<double>(one.drawn) / static_cast<double>(one.fiblets)),
                              shortNumber(one.ratio()), shortNumber(segments / one.unculled.median() * 1e-3)});
        report.series.push_back(one.culled);
        report.series.push_back(one.unculled);
        if (size.bound > 0) {
            report.checks.push_back(
                {"culled / unculled, " + std::to_string(size.fibres) + " fibres", one.ratio(), "<=", size.bound});
        }
    }
    report.tables.push_back(table);
    report.checks.push_back({"million segments a second, unculled, whole frame, 100000 fibres",
                             static_cast<double>(all[1].segments) / all[1].unculled.median() * 1e-3, ">=", 20});
    report.checks.push_back({"MB on the device, 100000 fibres", static_cast<double>(all[1].device_bytes) * 1e-6, "<=", 150});
    report.checks.push_back(
        {"ten times the fibres, culled, 10000 to 100000", all[1].culled.median() / all[0].culled.median(), "<=", 3});
    noteShortfalls(report, height, kHeight);
    return report;
}

}  // namespace radiata::lab
