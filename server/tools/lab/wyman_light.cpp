// Experiments about the error of the illumination lattice, against path tracing in double: wyman-fig6 (which texels light a
// point), wyman-fig7 (convergence by payload), wyman-fig12 (resolution), illumination-pareto (time against error). Source:
// Wyman et al. 2006.
#include <algorithm>

#include "build/folded_ball.h"
#include "tools/lab/experiments.h"
#include "tools/lab/light_bench.h"

namespace radiata::lab {
namespace {

/// The folded ball, with what is said of errors.
struct BallBench : LightBench {
    BallBench(gpu::Device& device, const Options& options, const char* name)
        : LightBench(device, options, name, foldedBall(64), 30, "folded ball of 64^3 voxels") {
        noteErrors();
    }
};

}  // namespace

Report wymanFig6(gpu::Device& device, const Options& options) {
    BallBench bench(device, options, "wyman-fig6");
    Table table{"error by texels that light a point", {"texels", "on their own level sets", "on the shown surface"}, {}};
    const LightTruth truth = bench.truth(LabSky::kWideSun);
    double trilinear = 0, tricubic = 0;
    for (const auto& [name, way] : {std::pair{"own isovalue", model::TexelInterpolation::kOwnIsovalue},
                                    std::pair{"nearest", model::TexelInterpolation::kNearest},
                                    std::pair{"trilinear", model::TexelInterpolation::kTrilinear},
                                    std::pair{"tricubic", model::TexelInterpolation::kTricubic}}) {
        std::vector<std::string> row{name};
        for (const bool project : {false, true}) {
            model::FrameRequest request = bench.request(LabSky::kWideSun);
            LightBench::lightOf(request).interpolation = way;
            LightBench::lightOf(request).project = project;
            const double error = lightError(bench.draw(request), truth);
            row.push_back(percent(error));
            if (!project && way == model::TexelInterpolation::kTrilinear) trilinear = error;
            if (!project && way == model::TexelInterpolation::kTricubic) tricubic = error;
        }
        table.rows.push_back(row);
    }
    bench.report.tables.push_back(table);
    bench.report.checks.push_back({"tricubic / trilinear, own level sets", tricubic / trilinear, ">=", 0.95});
    bench.report.notes.push_back("the paper finds tricubic interpolation equal or worse");
    return bench.report;
}

Report wymanFig7(gpu::Device& device, const Options& options) {
    BallBench bench(device, options, "wyman-fig7");
    Table table{"error by samples per texel", {"samples", "irradiance", "transfer (5, 3, 2, 2)"}, {}};
    const LightTruth truth = bench.truth(LabSky::kWideSun);
    Plot plot{"samples against error",
              "samples per texel",
              "relative error",
              true,
              true,
              false,
              {{"irradiance", {}, true}, {"transfer", {}, true}}};
    for (int samples = 4; samples <= 1024; samples *= 4) {
        std::vector<std::string> row{std::to_string(samples)};
        for (const bool transfer : {false, true}) {
            model::FrameRequest request = bench.request(LabSky::kWideSun);
            model::Illumination& light = LightBench::lightOf(request);
            light.payload = transfer ? model::TexelPayload::kTransfer : model::TexelPayload::kIrradiance;
            light.relative_error = 0.001F;
            light.samples_max = samples;
            light.budget_mib = 64 + static_cast<float>(samples) / 1024;  // texels of their own for each number of samples
            const double error = lightError(bench.draw(request), truth);
            row.push_back(percent(error));
            plot.curves[transfer ? 1 : 0].points.push_back({static_cast<double>(samples), error, ""});
        }
        table.rows.push_back(row);
    }
    bench.report.tables.push_back(table);
    bench.report.plots.push_back(plot);
    bench.report.notes.push_back("transfer blurs the sun, so its error stays where its few bands end");
    return bench.report;
}

Report wymanFig12(gpu::Device& device, const Options& options) {
    LabVolume volume = headOrBall(64);
    LightBench bench(device, options, "wyman-fig12", std::move(volume.image), volume.isovalue, volume.name, 96);
    bench.noteErrors();
    Table table{"error by resolution of the lattice",
                {"sky", "texels per voxel", "own level sets", "texels", "shown surface", "ratio"},
                {}};
    for (const LabSky sky : {LabSky::kEven, LabSky::kWideSun, LabSky::kSun}) {
        const LightTruth truth = bench.truth(sky);
        for (const auto& [name, resolution] :
             {std::pair{"1/8", model::LatticeResolution::kEighth}, std::pair{"1", model::LatticeResolution::kOne},
              std::pair{"8", model::LatticeResolution::kEight}}) {
            model::FrameRequest request = bench.request(sky);
            LightBench::lightOf(request).resolution = resolution;
            LightBench::lightOf(request).samples_max = 128;
            const double rest = lightError(bench.draw(request), truth);
            LightBench::lightOf(request).project = false;
            const model::Frame own_frame = bench.draw(request);
            const double own = lightError(own_frame, truth);
            table.rows.push_back({lab::name(sky), name, percent(own),
                                  std::to_string(own_frame.info.illumination->texels_needed), percent(rest),
                                  shortNumber(rest / own)});
            if (resolution == model::LatticeResolution::kOne && sky != LabSky::kEven) {
                bench.report.checks.push_back({"shown surface / own level sets, " + lab::name(sky), rest / own, "<=", 0.65});
            }
        }
    }
    bench.report.tables.push_back(table);
    bench.report.notes.push_back("texels of 128 samples at most, or a standard error of 2 %");
    return bench.report;
}

Report illuminationPareto(gpu::Device& device, const Options& options) {
    LabVolume volume = headOrBall(64);
    LightBench bench(device, options, "illumination-pareto", std::move(volume.image), volume.isovalue, volume.name, 128);
    bench.noteErrors();
    Table table{
        "time against error", {"light", "samples at most", "seconds", "error", "standard error", "texels of lattice"}, {}};
    Plot plot{"time against error", "seconds for the picture", "relative error", true, true, true, {}};
    const LightTruth truth = bench.truth(LabSky::kWideSun);
    model::Illumination own, shown, transfer, traced;
    own.project = false;
    transfer.payload = model::TexelPayload::kTransfer;
    traced.method = model::IlluminationMethod::kPathTracing;
    for (const auto& [name, way] :
         {std::pair{"irradiance, own level sets", own}, std::pair{"irradiance, shown surface", shown},
          std::pair{"transfer, shown surface", transfer}, std::pair{"path tracing of pixels", traced}}) {
        Curve curve{name, {}, true};
        // The first picture makes the pipelines.
        for (int samples = 1; samples <= 256; samples *= 4) {
            model::FrameRequest request = bench.request(LabSky::kWideSun);
            model::Illumination& light = LightBench::lightOf(request);
            light.method = way.method;
            light.payload = way.payload;
            light.project = way.project;
            light.relative_error = 0.001F;
            light.samples_max = std::max(samples, 4);
            light.budget_mib = 512 + static_cast<float>(samples) / 1024;  // texels of their own
            const model::Frame frame = bench.draw(request);
            if (samples < 4) continue;
            const model::IlluminationInfo& info = *frame.info.illumination;
            const double error = lightError(frame, truth), seconds = frame.info.render_ms / 1000;
            curve.points.push_back({seconds, error, ""});
            const double share = static_cast<double>(info.texels_needed) / static_cast<double>(info.texels);
            const bool pixels = way.method == model::IlluminationMethod::kPathTracing;
            table.rows.push_back({name, std::to_string(samples), shortNumber(seconds), percent(error), percent(info.mean_error),
                                  pixels ? "-" : percent(share)});
        }
        plot.curves.push_back(curve);
    }
    bench.report.tables.push_back(table);
    bench.report.plots.push_back(plot);
    bench.report.notes.push_back(
        "a picture's texels serve the next camera, and with transfer the next light; path tracing begins anew with each");
    return bench.report;
}

}  // namespace radiata::lab
