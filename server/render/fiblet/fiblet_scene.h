// The fiblets of a tractogram as they stand on the device, whatever the layers that show them look like.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gpu/buffer.h"
#include "model/fiblet_set.h"
#include "plan/camera_rays.h"
#include "render/fiblet/fiblet_residency.h"
#include "shaders/shared/fiblet_draw.glsl"

namespace radiata::render {

class FibletScene {
public:
    static constexpr std::uint32_t kPageFiblets = shader::FIBLET_PAGE;

    /// Uploads everything but the columns; of a set that takes more than the budget a table and a subset, and pages as they are
    /// wanted. \param budget_bytes  0: everything whatever it takes
    /// \throws Error(kUnsupported) for more fiblets than the picture's words can name, Error(kResourceExhausted)
    FibletScene(gpu::Device& device, std::shared_ptr<const model::FibletSet> set, std::uint64_t budget_bytes = 0);

    const model::FibletSet& set() const { return *set_; }
    std::uint64_t fibletCount() const { return set_->heads.size(); }
    const std::vector<shader::FibletPage>& pages() const { return set_->pages; }
    const plan::SceneBounds& bounds() const { return bounds_; }
    /// Largest distance of a point from the set's origin, mm.
    double reachMm() const { return reach_mm_; }
    /// Tells scenes apart; never 0.
    std::uint64_t serial() const { return serial_; }
    std::uint64_t deviceBytes() const;
    /// What is on the device of a set beyond the budget; null: all of it is.
    FibletResidency* residency() const { return residency_.get(); }
    std::uint64_t residentPages() const { return residency_ ? residency_->residentPages() : pages().size(); }

    std::uint64_t headAddress() const { return residency_ ? residency_->headAddress() : heads_.address(); }
    std::uint64_t codeAddress() const { return residency_ ? residency_->codeAddress() : codes_.address(); }
    std::uint64_t pageAddress() const { return pages_.address(); }
    std::uint64_t boxAddress() const { return residency_ ? residency_->boxAddress() : boxes_.address(); }
    /// Of shader::FibletPlaces; 0: fiblets lie in their own order.
    std::uint64_t placeAddress() const { return residency_ ? residency_->placeAddress() : 0; }

private:
    std::shared_ptr<const model::FibletSet> set_;
    plan::SceneBounds bounds_;  ///< world
    double reach_mm_ = 0;
    std::uint64_t serial_ = 0;
    gpu::Buffer heads_, codes_, pages_, boxes_;  ///< with a residency only the pages
    std::unique_ptr<FibletResidency> residency_;
};

}  // namespace radiata::render
