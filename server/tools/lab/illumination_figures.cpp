// Figures about the illumination lattice: illumination-sampling (low-discrepancy paths against random ones), illumination-first
// (time to the first lit picture, and what it costs from then on), illumination-memory (dense and sparse lattices).
#include <algorithm>
#include <cmath>

#include "build/folded_ball.h"
#include "tools/lab/experiments.h"
#include "tools/lab/light_bench.h"
#include "tools/lab/measure.h"
#include "tools/lab/statistics.h"

namespace radiata::lab {
namespace {

double linearOf(std::uint8_t value) {
    const double v = value / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// Root mean square of the differences of two pictures' red, where there is a surface, relative to the mean.
double difference(const model::Frame& a, const model::Frame& b) {
    double squares = 0, sum = 0, pixels = 0;
    for (std::size_t i = 0; i < a.pixels.rgba.size(); i += 4) {
        if (b.pixels.rgba[i] == 0) continue;
        const double off = linearOf(a.pixels.rgba[i]) - linearOf(b.pixels.rgba[i]);
        squares += off * off;
        sum += linearOf(b.pixels.rgba[i]);
        ++pixels;
    }
    return std::sqrt(squares / pixels) / (sum / pixels);
}

/// Samples at which a curve of errors reaches `wanted`, between its points by straight lines of logarithms.
double samplesFor(const std::vector<std::pair<int, double>>& curve, double wanted) {
    for (std::size_t i = 1; i < curve.size(); ++i) {
        if (curve[i].second > wanted && i + 1 < curve.size()) continue;
        const double slope =
            std::log(curve[i].second / curve[i - 1].second) / std::log(double(curve[i].first) / curve[i - 1].first);
        return curve[i - 1].first * std::exp(std::log(wanted / curve[i - 1].second) / slope);
    }
    return curve.back().first;
}

}  // namespace

Report illuminationSampling(gpu::Device& device, const Options& options) {
    LightBench bench(device, options, "illumination-sampling", foldedBall(48), 30, "folded ball of 48^3 voxels", 128);
    Table table{"error of the picture by samples per texel", {"sky", "paths", "4", "16", "64", "256"}, {}};
    for (const LabSky sky : {LabSky::kEven, LabSky::kWideSun, LabSky::kSun}) {
        model::FrameRequest request = bench.request(sky);
        model::Illumination& light = LightBench::lightOf(request);
        // Few numbers a texel and none of a mean over neighbours, so that noise is all that differs.
        light.project = false;
        light.interpolation = model::TexelInterpolation::kNearest;
        light.storage = model::TexelStorage::kFloat32;
        light.relative_error = 0.001F;
        light.samples_max = 4096;
        const model::Frame truth = bench.draw(request);
        std::vector<std::pair<int, double>> curves[2];
        for (const bool random : {false, true}) {
            light.sampling = random ? model::TexelSampling::kRandom : model::TexelSampling::kLowDiscrepancy;
            std::vector<std::string> row{lab::name(sky), random ? "random" : "low-discrepancy"};
            for (const int samples : {4, 16, 64, 256}) {
                light.samples_max = samples;
                light.budget_mib = 64 + static_cast<float>(samples) / 1024;  // texels of their own
                const double error = difference(bench.draw(request), truth);
                curves[random ? 1 : 0].emplace_back(samples, error);
                row.push_back(percent(error));
            }
            table.rows.push_back(row);
        }
        const double share = samplesFor(curves[0], curves[1].back().second) / 256;
        bench.report.checks.push_back({"samples for the error of 256 random ones, share, " + lab::name(sky), share, "<=", 0.5});
    }
    bench.report.tables.push_back(table);
    bench.report.notes.push_back("against low-discrepancy paths, 4096 samples per texel; the nearest texel lights a pixel");
    return bench.report;
}

Report illuminationFirst(gpu::Device& device, const Options& options) {
    const int height = pictureHeight(device, options, 512, 512);
    LightBench bench(device, options, "illumination-first", foldedBall(96), 30, "folded ball of 96^3 voxels", height);
    bench.report.repeats = options.rounds(7);
    model::FrameRequest lit = bench.request(LabSky::kEven);
    model::FrameRequest plain = lit;
    plain.scene.light.illumination.reset();
    lit.quality.samples = 2;  // the first of two is shown at once, with four samples a texel
    model::FrameRequest transfer = lit;
    LightBench::lightOf(transfer).payload = model::TexelPayload::kTransfer;
    Series primary{"primary rays, local light", "ms", {}};
    Series irradiance{"first lit picture, irradiance", "ms", {}}, other{"first lit picture, transfer", "ms", {}};
    model::IlluminationInfo info;
    int round = 0;
    const auto first = [&](model::FrameRequest& request) {
        // A budget of its own makes a lattice of its own, without texels.
        LightBench::lightOf(request).budget_mib = 512 + static_cast<float>(++round);
        render::Target target;
        const model::Frame frame = bench.renderer().render(target, request, 0, 1);
        info = *frame.info.illumination;
        return frame.info.render_ms;
    };
    interleave(bench.report.repeats,
               {[&] { primary.values.push_back(bench.draw(plain).info.render_ms); },
                [&] { irradiance.values.push_back(first(lit)); }, [&] { other.values.push_back(first(transfer)); }});
    for (Series* series : {&primary, &irradiance, &other}) series->values.erase(series->values.begin());
    const double base = primary.median();
    Table table{"time to the first lit picture", {"picture", "ms", "of primary rays"}, {}};
    for (const Series& series : {primary, irradiance, other}) {
        table.rows.push_back({series.name, shortNumber(series.median()), shortNumber(series.median() / base)});
        bench.report.series.push_back(series);
    }
    bench.report.tables.push_back(table);
    const double share = static_cast<double>(info.texels_needed) / static_cast<double>(info.texels);
    bench.report.notes.push_back("four samples for each of " + std::to_string(info.texels_needed) + " texels, " +
                                 percent(share) + " of the lattice");
    bench.report.checks.push_back({"texels of the view, share of the lattice", share, "<=", 0.06});
    bench.report.checks.push_back({"first lit picture / primary rays, irradiance", irradiance.median() / base, "<=", 6});
    bench.report.checks.push_back({"first lit picture / primary rays, transfer", other.median() / base, "<=", 6});
    return bench.report;
}

namespace {

const glm::ivec3 kEngine{110, 208, 149};  ///< the paper's engine block
constexpr double kMib = 1048576;

/// The part of an image from `first` on that is as large as the engine block.
model::ScalarImage cutOut(const model::ScalarImage& from, const glm::ivec3& first) {
    model::ScalarImage cut;
    cut.size = kEngine;
    cut.source = from.source;
    cut.voxel_to_world[3] = glm::dvec4(-0.5 * glm::dvec3(kEngine - 1), 1);
    for (int z = 0; z < cut.size.z; ++z) {
        for (int y = 0; y < cut.size.y; ++y) {
            for (int x = 0; x < cut.size.x; ++x) cut.values.push_back(from.at(first + glm::ivec3(x, y, z)));
        }
    }
    return cut;
}

model::ScalarImage smoothBall() {
    model::ScalarImage image;
    image.size = kEngine;
    image.source = "ball";
    image.voxel_to_world[3] = glm::dvec4(-0.5 * glm::dvec3(kEngine - 1), 1);
    for (int z = 0; z < kEngine.z; ++z) {
        for (int y = 0; y < kEngine.y; ++y) {
            for (int x = 0; x < kEngine.x; ++x) {
                const double r = glm::length(glm::dvec3(x, y, z) - 0.5 * glm::dvec3(kEngine - 1));
                image.values.push_back(static_cast<float>(100 * (1 - r / 87)));
            }
        }
    }
    return image;
}

struct Memory {
    model::IlluminationInfo one, all;  ///< after one view, after six
};

Memory memoryOf(LightBench& bench, const model::FrameRequest& wanted) {
    model::FrameRequest request = wanted;
    Memory memory;
    for (const glm::dvec3& towards : {glm::dvec3(1, 0.2, 0.1), glm::dvec3(-1, 0.1, 0.2), glm::dvec3(0.2, 1, 0.1),
                                      glm::dvec3(0.1, -1, 0.2), glm::dvec3(0.2, 0.1, 1), glm::dvec3(0.1, 0.2, -1)}) {
        request.camera.eye_mm = request.camera.target_mm + 350.0 * glm::normalize(towards);
        memory.all = *bench.draw(request).info.illumination;
        if (memory.one.bytes == 0) memory.one = memory.all;
    }
    return memory;
}

}  // namespace

Report illuminationMemory(gpu::Device& device, const Options& options) {
    Report report;
    const double dense_texels = static_cast<double>(kEngine.x) * kEngine.y * kEngine.z;
    Table table{"MiB of texels, 110x208x149 voxels as the paper's engine block",
                {"isosurface", "texels keep", "bytes a texel", "dense, light", "one view", "six views", "of dense light"},
                {}};
    std::vector<LabVolume> volumes{{cutOut(foldedBall(208), {49, 0, 29}), 30, "folded ball"},
                                   {smoothBall(), 30, "smooth ball"}};
    if (LabVolume head = headOrBall(16); head.head) {
        volumes.push_back({cutOut(head.image, {36, 30, 80}), head.isovalue, "cortex of a T1 image"});
    }
    for (LabVolume& volume : volumes) {
        LightBench bench(device, options, "illumination-memory", std::move(volume.image), volume.isovalue, volume.name, 512);
        if (report.experiment.empty()) report = bench.report;
        for (const auto& [name, payload, storage] :
             {std::tuple{"irradiance, RGB8", model::TexelPayload::kIrradiance, model::TexelStorage::kRgb8},
              std::tuple{"irradiance by bounces, fp16", model::TexelPayload::kIrradiance, model::TexelStorage::kFloat16},
              std::tuple{"transfer (5, 3, 2, 2), fp16", model::TexelPayload::kTransfer, model::TexelStorage::kFloat16}}) {
            model::FrameRequest request = bench.request(LabSky::kEven);
            model::Illumination& light = LightBench::lightOf(request);
            light.payload = payload;
            light.storage = storage;
            light.relative_error = 1;
            light.samples_max = 4;
            light.project = false;
            const bool transfer = payload == model::TexelPayload::kTransfer;
            if (!transfer && &volume != volumes.data()) continue;
            const double words = storage == model::TexelStorage::kRgb8 ? 1 : std::ceil(light.payloadCount() / 2.0);
            const Memory memory = memoryOf(bench, request);
            const double dense = dense_texels * 4 * words / kMib;
            const double one = static_cast<double>(memory.one.bytes) / kMib,
                         sparse = static_cast<double>(memory.all.bytes) / kMib;
            table.rows.push_back({volume.name, name, shortNumber(4 * words), shortNumber(dense), shortNumber(one),
                                  shortNumber(sparse), shortNumber(sparse / dense)});
            if (!transfer) continue;
            report.checks.push_back({volume.name + ", dense, MiB of transfer", dense, "<=", 275});
            report.checks.push_back({volume.name + ", six views, MiB with everything, of 275", sparse / 275, "<=", 1.0 / 3});
        }
    }
    report.scene = "isosurfaces in lattices of 110x208x149 texels";
    report.tables.push_back(table);
    report.notes.push_back(
        "views count everything that stays once texels are done: light, state and place of the texels that were needed, 8 "
        "bytes of what is shown for each texel of a brick, the index; six views see the whole outside of an isosurface");
    report.notes.push_back("the paper: 9.75 MB for RGB8, 975 MB for transfer of order 5 in fp32");
    return report;
}

}  // namespace radiata::lab
