#include "tools/lab/light_bench.h"

#include <cstdlib>
#include <filesystem>

#include "build/folded_ball.h"
#include "io/scalar_image.h"

namespace radiata::lab {

LabVolume headOrBall(int size) {
    if (const char* folder = std::getenv("RADIATA_DATA")) {
        const std::filesystem::path file = std::filesystem::path(folder) / "vols" / "t1_studyforrest_1mm.nii.gz";
        std::error_code failure;
        if (std::filesystem::is_regular_file(file, failure)) {
            model::ScalarImage image = io::readScalarImage(file);
            const glm::dvec3 middle = 0.5 * glm::dvec3(image.size - 1);
            image.voxel_to_world = glm::dmat4(1);
            image.voxel_to_world[3] = glm::dvec4(-middle, 1);
            const std::string extent =
                std::to_string(image.size.x) + "x" + std::to_string(image.size.y) + "x" + std::to_string(image.size.z);
            return {std::move(image), 60, "T1 image of a head (" + extent + " voxels of 1 mm, public), isovalue 60: cortex",
                    true};
        }
    }
    return {foldedBall(size), 30, "folded ball of " + std::to_string(size) + "^3 voxels"};
}

namespace {

constexpr int kPaperHeight = 512, kReducedHeight = 256;

}  // namespace

ReadyFrames::ReadyFrames(gpu::Device& device, const Options& options, const char* name, const std::string& scene)
    : LightBench(device, options, name, foldedBall(96), 30, scene,
                 pictureHeight(device, options, kPaperHeight, kReducedHeight)) {
    report.scene = scene;
    report.repeats = options.rounds();
    noteShortfalls(report, height(), pictureHeight(device, {}, kPaperHeight, kReducedHeight));
}

model::FrameRequest ReadyFrames::lit(float error, int samples) const {
    model::FrameRequest request = LightBench::request(LabSky::kWideSun);
    lightOf(request).relative_error = error;
    lightOf(request).samples_max = samples;
    return request;
}

model::FrameRequest ReadyFrames::local(model::FrameRequest lit) {
    lit.scene.light.direction_world = glm::dvec3(lightOf(lit).suns[0].direction);
    lit.scene.light.illumination.reset();
    return lit;
}

model::FrameRequest ReadyFrames::shadowed(model::FrameRequest local) {
    local.scene.light.shadow = model::Shadow::kHard;
    return local;
}

std::vector<Measured> ReadyFrames::measureAll(const std::vector<Candidate>& candidates) {
    const std::vector<Measured> measured = measure(renderer(), candidates, report.repeats, {});
    for (const Measured& method : measured) report.series.push_back(method.time);
    return measured;
}

}  // namespace radiata::lab
