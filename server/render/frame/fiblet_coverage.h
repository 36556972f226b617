// The coverage buffer of one layer of fiblets in one view: which fiblets the latest picture hides, by the scheme of Schertzer
// et al. 2022, Sec. 3.4. It is not conservative (docs/architecture.md, "Fibres"), and pictures depend on those before; for
// comparisons.
#pragma once

#include <vector>

#include "gpu/buffer.h"
#include "render/frame/fiblet_run.h"
#include "shaders/shared/fiblet_coverage.glsl"

namespace radiata::render {

class FibletCoverage {
public:
    /// Brings the buffer to the layer's camera, if it is of the same fibres, cuts and window, and lists the fiblets that are
    /// then to be drawn. Records; the caller submits.
    void cull(FibletRun& layer);
    /// Dilates the finished depths; needs the pyramid up to FIBLET_TEXEL_LEVEL. Records; the caller submits.
    void remember(FibletRun& layer);

    /// shader::FibletCoverageParams::dilated as it stands, and its view; for tests.
    const gpu::Buffer& dilated() const { return dilated_; }
    shader::FibletCoverageParams& params() const {
        return *reinterpret_cast<shader::FibletCoverageParams*>(params_.mapped().data());
    }

private:
    /// Of what the buffer tells, beside the camera.
    struct Key {
        std::uint64_t scene_serial = 0, states = 0;
        glm::ivec2 window{0};
        std::vector<glm::vec4> cuts;
        bool operator==(const Key&) const = default;
    };
    static Key keyOf(const FibletRun& layer);

    gpu::Buffer params_;           ///< shader::FibletCoverageParams
    gpu::Buffer dilated_, moved_;  ///< uint[texels]
    Key key_;
    bool known_ = false;
};

}  // namespace radiata::render
