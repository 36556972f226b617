#include "tools/lab/scenes.h"

#include <cmath>
#include <filesystem>
#include <random>

#include "build/phantom.h"
#include "io/sh_image.h"
#include "math/sh_evaluate.h"
#include "store/glyph_dataset.h"

namespace radiata::lab {
namespace {

std::vector<float> lobes(int k, double damping, double isotropic) {
    const ShLayout layout{k, false};
    std::vector<double> sum(layout.count(), 0.0), basis(layout.count());
    const glm::dvec3 axes[] = {{0.9, 0.3, 0.31}, {-0.25, 0.93, 0.27}, {0.1, -0.42, 0.9}};
    const double weights[] = {1.0, 0.8, 0.6};
    for (int lobe = 0; lobe < 3; ++lobe) {
        evaluateSh(layout, glm::normalize(axes[lobe]), basis);
        for (int l = 0; l <= k; l += 2) {
            for (int m = -l; m <= l; ++m) {
                const std::size_t at = layout.index(l, m);
                sum[at] += weights[lobe] * basis[at] * std::exp(-damping * l * (l + 1));
            }
        }
    }
    sum[0] *= isotropic;
    return {sum.begin(), sum.end()};
}

}  // namespace

model::ShImage oneGlyph(ShLayout layout, const std::vector<float>& coefficients) {
    model::ShImage image;
    image.size = glm::ivec3(1);
    image.layout = layout;
    image.voxels = {glm::ivec3(0)};
    image.coefficients = coefficients;
    return image;
}

std::vector<float> fibreLobes(int k) { return lobes(k, 0.012, 1); }
std::vector<float> sharpenedLobes(int k) { return lobes(k, 0.002, 0.3); }

std::vector<float> uniformGlyph(ShLayout layout, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<float> coefficients(layout.count());
    // By hand: the standard's distributions differ between libraries.
    for (float& c : coefficients) c = static_cast<float>(2 * (static_cast<double>(random()) / 4294967296.0) - 1);
    return coefficients;
}

model::ShImage slice(const Options& options, int lmax, std::uint64_t glyphs, std::string& description) {
    model::ShImage image;
    if (options.image.empty()) {
        PhantomOptions phantom;
        phantom.slice_glyphs = glyphs;
        phantom.lmax = lmax;
        description = "phantom slice, seed " + std::to_string(phantom.seed);
        image = phantomShImage(phantom);
    } else {
        image = io::readShImage(options.image);
        description = std::filesystem::path(options.image).filename().string();
    }
    description += ", " + std::to_string(image.voxels.size()) + " glyphs, lmax " + std::to_string(image.layout.lmax);
    return image;
}

model::FrameRequest requestOf(const std::string& dataset, int width, int height, bool both_lobes) {
    model::FrameRequest request;
    request.width = width;
    request.height = height;
    request.quality.samples = 1;
    request.quality.traversal = model::Traversal::kBvh;
    request.scene.annotations.hidden = true;
    model::Layer layer;
    layer.glyphs().dataset_id = dataset;
    layer.glyphs().selection.region = model::Region::kVolume;
    layer.glyphs().negative_lobes = both_lobes ? model::NegativeLobes::kShown : model::NegativeLobes::kHidden;
    request.scene.layers = {layer};
    return request;
}

model::FrameRequest filledRequest(store::Store& store, const std::string& dataset, int size, double zoom) {
    model::FrameRequest request = requestOf(dataset, size, size, true);
    request.scene.layers[0].glyphs().scale = {model::ScaleMode::kAbsolute, 1.0F};
    const auto glyphs = store.glyphs(dataset);
    const std::vector<std::uint32_t> first{0};
    const double radius = static_cast<double>(glyphs->bounds(first, glyphs->image().layout.lmax, true)[0].radius);
    request.camera.eye_mm = {0.3 * radius, -0.5 * radius, 4 * radius};
    request.camera.target_mm = {0, 0, 0};
    request.camera.height_mm = 2 * radius * zoom;
    return request;
}

}  // namespace radiata::lab
