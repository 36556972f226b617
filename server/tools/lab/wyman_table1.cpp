// wyman-table1: time to light what one view needs, the whole lattice, and one picture by path tracing, over samples.
// Source: Wyman et al. 2006, Table 1.
#include <chrono>
#include <cmath>

#include "build/folded_ball.h"
#include "tools/lab/experiments.h"
#include "tools/lab/light_bench.h"

namespace radiata::lab {
namespace {

double secondsSince(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

Report wymanTable1(gpu::Device& device, const Options& options) {
    constexpr int kMeasured = 64, kWhole = 4, kTracedPixels = 120, kTracedPaths = 16;
    const int height = pictureHeight(device, options, 900, 256);
    LightBench bench(device, options, "wyman-table1", foldedBall(96), 30, "folded ball of 96^3 voxels", height);
    const std::vector<int> counts{64, 256, 1024, 4096};
    Table table{"seconds by samples per texel", {"light", "texels", "64", "256", "1024", "4096"}, {}};
    double lazy_texels = 0, all_texels = 0;
    const auto addRow = [&](const std::string& name, const std::string& texels, double per_sample, int measured) {
        std::vector<std::string> row{name, texels};
        for (const int count : counts) {
            row.push_back(shortNumber(per_sample * count) + (count == measured ? "" : " extrapolated"));
        }
        table.rows.push_back(row);
    };
    for (const bool transfer : {true, false}) {
        const std::string name = transfer ? "transfer of order 5" : "irradiance";
        model::FrameRequest request = bench.request(LabSky::kSun);
        model::Illumination& light = LightBench::lightOf(request);
        light.payload = transfer ? model::TexelPayload::kTransfer : model::TexelPayload::kIrradiance;
        light.orders = {5, 5, 5, 5, 5};
        light.project = false;
        light.relative_error = 0.001F;
        light.samples_max = kMeasured;
        const model::IlluminationInfo lazy = *bench.draw(request).info.illumination;
        lazy_texels = static_cast<double>(lazy.texels_needed);
        addRow(name + ", lazy", std::to_string(lazy.texels_needed), lazy.seconds / kMeasured, kMeasured);
        // Every second texel along each axis, so an eighth of the lattice, evenly.
        light.full = true;
        light.resolution = model::LatticeResolution::kEighth;
        light.samples_max = kWhole;
        const model::IlluminationInfo whole = *bench.draw(request).info.illumination;
        all_texels = static_cast<double>(lazy.texels);
        addRow(name + ", full", std::to_string(lazy.texels),
               whole.seconds / kWhole * all_texels / static_cast<double>(whole.texels), 0);
    }
    const auto begin = std::chrono::steady_clock::now();
    const LightTruth traced =
        lightTruth(bench.renderer(), bench.image(), bench.request(LabSky::kSun), kTracedPixels, kTracedPaths);
    model::FrameRequest plain = bench.request(LabSky::kSun);
    plain.scene.light.illumination.reset();
    const double pixels = static_cast<double>(bench.draw(plain).info.hit_pixels);
    addRow("path tracing in double, one picture", std::to_string(static_cast<int>(pixels)) + " pixels",
           secondsSince(begin) / kTracedPaths * pixels / static_cast<double>(traced.pixels.size()), 0);
    bench.report.tables.push_back(table);
    bench.report.notes.push_back(
        "lazy rows ran with 64 samples; full rows on every second texel along each axis (an eighth of all) with 4 "
        "samples; path tracing on " +
        std::to_string(traced.pixels.size()) + " pixels with 16 paths; all else is extrapolated in proportion");
    bench.report.notes.push_back("path tracing is the reference's: in double, on the processor, meeting the sun by chance");
    bench.report.checks.push_back({"texels of the view, share of the lattice", lazy_texels / all_texels, "<=", 0.06});
    return bench.report;
}

}  // namespace radiata::lab
