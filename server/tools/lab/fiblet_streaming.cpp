// fiblet-streaming: a tractogram on a tenth of the device memory that it takes. Of the first picture and of one after a jump of
// 60 degrees: how long the view waits for it, how many frames it takes until every pixel is that of the whole, and what is
// read; then frames of a view at rest against those of the whole in memory. Seen whole, whose visible pages may not fit, and
// from near, whose do.
#include <chrono>
#include <filesystem>

#include <unistd.h>

#include "gpu/device.h"
#include "io/fiblet_file.h"
#include "render/fiblet/fiblet_residency.h"
#include "store/store.h"
#include "tools/lab/experiments.h"
#include "tools/lab/measure.h"
#include "tools/lab/statistics.h"
#include "tools/lab/tract_scenes.h"

namespace radiata::lab {
namespace {

constexpr std::size_t kFibres = 20'000;
constexpr int kHeight = 720;
constexpr std::uint64_t kShare = 10;  ///< of the bytes: one in so many
constexpr double kNearer = 128;       ///< fibres are longer than a page is wide, so a narrow view meets many pages

/// A folder for one file, gone in the end.
struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("radiata-lab-streaming-" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
};

/// From a change of the camera to the picture that is finished.
struct Convergence {
    double first_ms = 0, all_ms = 0;
    int frames = 0;
    std::uint64_t bytes = 0;
    model::FrameInfo last;
    bool same = false;  ///< as the picture of the whole, in every byte
};

Convergence converge(render::Renderer& renderer, render::Target& target, const model::FrameRequest& request,
                     const std::vector<std::uint8_t>& expected) {
    Convergence result;
    const auto begin = std::chrono::steady_clock::now();
    const auto passed = [&] {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    };
    model::Frame frame;
    for (int samples = 0; samples < request.quality.samples; samples = frame.info.samples) {
        frame = renderer.render(target, request, samples, 1);
        if (result.frames++ == 0) result.first_ms = passed();
        result.bytes += frame.info.fiblet_bytes_read;
    }
    result.all_ms = passed();
    result.last = frame.info;
    result.same = frame.pixels.rgba == expected;
    return result;
}

std::vector<std::string> row(const std::string& name, const Convergence& c) {
    return {name,
            std::to_string(c.last.fiblet_pages_wanted),
            std::to_string(c.last.fiblet_pages_left_out),
            shortNumber(c.first_ms),
            shortNumber(c.all_ms),
            std::to_string(c.frames),
            shortNumber(static_cast<double>(c.bytes) * 1e-6),
            c.same                             ? "every byte"
            : c.last.fiblet_pages_left_out > 0 ? "subset shown"
                                               : "differs"};
}

}  // namespace

Report fibletStreaming(gpu::Device& device, const Options& options) {
    Report report;
    report.experiment = "fiblet-streaming";
    report.repeats = options.rounds();
    report.scene = std::to_string(kFibres) + " generated fibres of 800 points, 0.1 mm apart, in a ball of 140 mm, from a file";
    const int height = pictureHeight(device, options, kHeight, kHeight);
    report.view = std::to_string(height * 16 / 9) + "x" + std::to_string(height) + ", two samples, lines lit";
    const Folder folder;
    std::uint64_t whole_bytes = 0, pages = 0;
    {
        const model::FibletSet set = ballOfFibres(kFibres);
        io::writeFiblets(set, folder.path / "fibres.fiblet");
        whole_bytes = render::FibletResidency::wholeBytes(set);
        pages = set.pages.size();
    }
    store::Store store(device, {});
    store.add(folder.path / "fibres.fiblet");
    model::Limits limits;
    limits.tract_memory_bytes = whole_bytes / kShare;
    render::Renderer all(device, store), some(device, store, limits);
    report.device = all.deviceName();
    model::FrameRequest request = fibreFrame(height, "fibres");
    request.quality.samples = 2;
    const model::Camera fitted =
        all.fitCamera("fibres", {}, model::Convention::kRadiological, static_cast<double>(request.width) / request.height);
    Table table{"until a picture of " + std::to_string(pages) + " pages is finished",
                {"view", "pages seen", "left out", "first picture, ms", "finished, ms", "frames", "MB read", "as the whole"},
                {}};
    bool near_same = true;
    for (const bool near : {false, true}) {
        const std::string view = near ? "near" : "whole";
        model::Camera camera = fitted;
        if (near) camera.height_mm = fitted.height_mm / kNearer;
        render::Target target, all_target;
        for (const bool turned : {false, true}) {
            request.camera = turned ? model::orbit(camera, 60, 0) : camera;
            const model::Frame expected = all.renderAll(request);
            const Convergence c = converge(some, target, request, expected.pixels.rgba);
            table.rows.push_back(row(view + (turned ? ", after a jump" : ", nothing read before"), c));
            near_same = near_same && (c.same || !near);
        }
        Series with{view + ", a tenth in memory", "ms", {}}, without{view + ", all in memory", "ms", {}};
        interleave(report.repeats, {[&] { with.values.push_back(some.render(target, request, 0, 2).info.render_ms); },
                                    [&] { without.values.push_back(all.render(all_target, request, 0, 2).info.render_ms); }});
        report.checks.push_back({"a tenth in memory / all, view at rest, " + view, with.median() / without.median(), "<=", 4});
        report.series.push_back(with);
        report.series.push_back(without);
    }
    report.tables.push_back(table);
    report.notes.push_back("the file was written before and is in the system's cache of files");
    report.notes.push_back("all takes " + shortNumber(static_cast<double>(whole_bytes) * 1e-6) + " MB on the device");
    report.checks.push_back({"pictures from near that differ from the whole", near_same ? 0.0 : 1.0, "<=", 0});
    noteShortfalls(report, height, kHeight);
    return report;
}

}  // namespace radiata::lab
