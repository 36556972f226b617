// The fiblets of a tractogram as they stand on the device, whatever the layers that show them look like.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gpu/buffer.h"
#include "model/fiblet_set.h"
#include "plan/camera_rays.h"
#include "shaders/shared/fiblet_draw.glsl"

namespace radiata::render {

class FibletScene {
public:
    static constexpr std::uint32_t kPageFiblets = shader::FIBLET_PAGE;

    /// Uploads everything but the columns.
    /// \throws Error(kUnsupported) for more fiblets than the picture's words can name, Error(kResourceExhausted)
    FibletScene(gpu::Device& device, std::shared_ptr<const model::FibletSet> set);

    const model::FibletSet& set() const { return *set_; }
    std::uint64_t fibletCount() const { return set_->heads.size(); }
    const std::vector<shader::FibletPage>& pages() const { return set_->pages; }
    const plan::SceneBounds& bounds() const { return bounds_; }
    /// Largest distance of a point from the set's origin, mm.
    double reachMm() const { return reach_mm_; }
    /// Tells scenes apart; never 0.
    std::uint64_t serial() const { return serial_; }
    std::uint64_t deviceBytes() const;

    std::uint64_t headAddress() const { return heads_.address(); }
    std::uint64_t codeAddress() const { return codes_.address(); }
    std::uint64_t pageAddress() const { return pages_.address(); }
    std::uint64_t boxAddress() const { return boxes_.address(); }

private:
    std::shared_ptr<const model::FibletSet> set_;
    plan::SceneBounds bounds_;  ///< world
    double reach_mm_ = 0;
    std::uint64_t serial_ = 0;
    gpu::Buffer heads_, codes_, pages_, boxes_;
};

}  // namespace radiata::render
