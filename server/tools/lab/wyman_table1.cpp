// wyman-table1: time to light what one view needs, the whole lattice, and one picture by path tracing, over samples.
// Source: Wyman et al. 2006, Table 1.
#include "tools/lab/experiments.h"
#include "tools/lab/light_bench.h"

namespace radiata::lab {

Report wymanTable1(gpu::Device& device, const Options& options) {
    constexpr int kMeasured = 16, kWhole = 4, kTracedShare = 4;
    const int height = pictureHeight(device, options, 900, 256);
    LabVolume volume = headOrBall(96);
    LightBench bench(device, options, "wyman-table1", std::move(volume.image), volume.isovalue, volume.name, height);
    const std::vector<int> counts{16, 64, 256, 1024, 4096};
    Table table{"seconds by samples", {"light", "texels or pixels", "16", "64", "256", "1024", "4096"}, {}};
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
    // The same view with a quarter of the rows and columns.
    model::FrameRequest request = bench.request(LabSky::kSun), plain = request;
    LightBench::lightOf(request).method = model::IlluminationMethod::kPathTracing;
    LightBench::lightOf(request).relative_error = 0.001F;
    LightBench::lightOf(request).samples_max = kMeasured;
    request.width /= kTracedShare;
    request.height /= kTracedShare;
    plain.scene.light.illumination.reset();
    const model::IlluminationInfo traced = *bench.draw(request).info.illumination;
    const double pixels = static_cast<double>(bench.draw(plain).info.hit_pixels);
    addRow("path tracing of one picture", std::to_string(static_cast<int>(pixels)) + " pixels",
           traced.seconds / kMeasured * pixels / static_cast<double>(traced.texels_needed), 0);
    bench.report.tables.push_back(table);
    bench.report.notes.push_back(
        "lazy rows ran with 16 samples; full rows on every second texel along each axis (an eighth of all) with 4 samples; "
        "path "
        "tracing on " +
        std::to_string(traced.texels_needed) +
        " pixels of the same view with 16 paths; all else is extrapolated in proportion");
    bench.report.notes.push_back("the paper's full lattices take 18 to 26 times as long as what one view needs");
    bench.report.checks.push_back({"texels of the view, share of the lattice", lazy_texels / all_texels, "<=", 0.06});
    return bench.report;
}

}  // namespace radiata::lab
