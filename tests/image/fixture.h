// A device, a store and a renderer for each test, and what two frames of one view have in common.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "gpu/device.h"
#include "image/scenes.h"
#include "render/frame/renderer.h"
#include "store/store.h"

namespace radiata::test {

class ImageTest : public ::testing::Test {
protected:
    explicit ImageTest(const gpu::DeviceOptions& options = {}) : device(options) {}

    /// Depth, id, position, normal and steps beside the picture.
    static model::Outputs everything() { return {true, true, true, true, true}; }
    model::Frame draw(const model::FrameRequest& request) { return renderer.renderAll(request, everything()); }

    gpu::Device device;
    store::Store store{device, {}};
    render::Renderer renderer{device, store};
};

/// Two frames of the same size, pixel by pixel.
struct Agreement {
    int hits = 0;            ///< pixels where the first shows something
    int other_ids = 0;       ///< pixels that show another layer or voxel, or nothing in one of the two
    double worst_depth = 0;  ///< mm, over pixels of equal ids that are not seen at a grazing angle (cosine under 0.1)
    double worst_apart = 0;  ///< mm along the normal, over all pixels of equal ids
};

inline Agreement compareSurfaces(const model::Frame& a, const model::Frame& b) {
    Agreement result;
    for (std::size_t i = 0; i < a.pixels.depth.size(); ++i) {
        bool same = true;
        for (std::size_t c = 0; c < 4; ++c) same = same && a.pixels.id[4 * i + c] == b.pixels.id[4 * i + c];
        const bool hit = a.pixels.id[4 * i] >= 0;
        result.hits += hit;
        result.other_ids += !same;
        if (!same || !hit) continue;
        const auto at = [i](const std::vector<float>& v) { return glm::dvec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]); };
        const glm::dvec3 normal = at(a.pixels.normal), place = a.info.position_origin_mm + at(a.pixels.position);
        const model::Camera& camera = a.info.request.camera;
        const glm::dvec3 sight = camera.perspective ? place - camera.eye_mm : camera.target_mm - camera.eye_mm;
        const glm::dvec3 step = place - b.info.position_origin_mm - at(b.pixels.position);
        result.worst_apart = std::max(result.worst_apart, std::abs(glm::dot(step, normal)));
        if (std::abs(glm::dot(glm::normalize(sight), normal)) < 0.1) continue;
        const double depth_a = static_cast<double>(a.pixels.depth[i]) + a.info.depth_offset_mm;
        const double depth_b = static_cast<double>(b.pixels.depth[i]) + b.info.depth_offset_mm;
        result.worst_depth = std::max(result.worst_depth, std::abs(depth_a - depth_b));
    }
    return result;
}

/// Runs and returns the code of the Error that must come.
template <typename Body>
Code codeOf(Body&& body) {
    try {
        body();
    } catch (const Error& error) {
        return error.code();
    }
    ADD_FAILURE() << "no Error was thrown";
    return Code::kInternal;
}

}  // namespace radiata::test
