// What experiments about the illumination lattice share: a volume in a store, views of it and the truth about them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "store/store.h"
#include "tools/lab/experiment.h"
#include "tools/lab/light_truth.h"
#include "tools/lab/measure.h"

namespace radiata::lab {

constexpr int kTruthPixels = 300;

/// A volume, a view of it and the truth about it.
class LightBench {
public:
    LightBench(gpu::Device& device, const Options& options, const char* name, model::ScalarImage image, float isovalue,
               const std::string& scene, int usual_height = 192)
        : store_(device, {}), renderer_(device, store_), image_(std::move(image)), isovalue_(isovalue) {
        store_.add("volume", image_);
        height_ = options.size > 0 ? options.size : usual_height;
        report.experiment = name;
        report.repeats = 1;
        report.device = renderer_.deviceName();
        report.scene = scene + ", albedo 0.7, three bounces";
        report.view = std::to_string(height_) + "x" + std::to_string(height_) + ", one sample per pixel";
    }
    void noteErrors() {
        report.notes.push_back("errors are root mean squares over " + std::to_string(kTruthPixels) +
                               " pixels against path tracing in double, relative to the mean, without the truth's own error");
    }
    model::FrameRequest request(LabSky sky) const { return litRequest(image_, "volume", isovalue_, sky, height_); }
    LightTruth truth(LabSky sky, int paths = 1500) { return lightTruth(renderer_, image_, request(sky), kTruthPixels, paths); }
    model::Frame draw(const model::FrameRequest& request, const model::Outputs& outputs = {}) {
        return renderer_.renderAll(request, outputs);
    }
    render::Renderer& renderer() { return renderer_; }
    const model::ScalarImage& image() const { return image_; }
    int height() const { return height_; }
    static model::Illumination& lightOf(model::FrameRequest& request) { return *request.scene.light.illumination; }

    Report report;

private:
    store::Store store_;
    render::Renderer renderer_;
    model::ScalarImage image_;
    float isovalue_;
    int height_ = 0;
};

/// The folded ball of 96^3 voxels under a sky and a sun of 18 degrees, in frames whose texels are ready: what its shadings
/// take.
class ReadyFrames : public LightBench {
public:
    ReadyFrames(gpu::Device& device, const Options& options, const char* name, const std::string& scene);
    /// \param error, samples  relative error at which texels are done, and samples that they have at most
    model::FrameRequest lit(float error, int samples) const;
    /// Local light from the sun's direction instead.
    static model::FrameRequest local(model::FrameRequest lit);
    static model::FrameRequest shadowed(model::FrameRequest local);
    /// Each is drawn once before: then its texels are there. Times, of all passes on the device, go into the report.
    std::vector<Measured> measureAll(const std::vector<Candidate>& candidates);
};

inline std::string percent(double value) { return shortNumber(100 * value) + " %"; }

/// A head if RADIATA_DATA names the folder of the real data, else the folded ball of `size`^3. Voxels are 1 mm along the
/// world's axes either way: the reference knows no others.
struct LabVolume {
    model::ScalarImage image;
    float isovalue;
    std::string name;
    bool head = false;
};
LabVolume headOrBall(int size);

}  // namespace radiata::lab
