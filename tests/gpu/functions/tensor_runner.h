// Cartesian tensors on the device: random glyphs of every order, the methods that draw them, and the truth in double.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "gpu/functions/march_runner.h"
#include "math/cartesian_tensor.h"
#include "math/tensor_sh.h"

namespace radiata::test {

/// One function under both its names.
struct TensorGlyph {
    int order = 0;
    std::vector<float> components;
    ShLayout layout;
    std::vector<float> coefficients;
    float radius = 0;  ///< certified
};

/// Amplitudes about 1; odd orders have odd bands only.
inline TensorGlyph randomTensorGlyph(std::mt19937& random, int order) {
    const TensorSh map(order);
    TensorGlyph glyph{order, {}, map.layout(), randomGlyph(random, map.layout()), 0};
    for (int l = 0; glyph.layout.full && l <= order; l += 2) {
        for (int m = -l; m <= l; ++m) glyph.coefficients[glyph.layout.index(l, m)] = 0;
    }
    std::vector<double> components(symmetricCount(order));
    map.toTensor(std::vector<double>(glyph.coefficients.begin(), glyph.coefficients.end()), components);
    glyph.components.assign(components.begin(), components.end());
    glyph.radius = certifiedRadius(BoundsEvaluator(glyph.layout), glyph.coefficients);
    return glyph;
}

enum class TensorMethod : std::uint32_t { kMarch, kInterval, kAffine };

struct TensorRun {
    TensorMethod method = TensorMethod::kMarch;
    float step = 0.01F;
    std::uint32_t bisections = 0;
    bool interpolate = true, adaptive = false;
    std::uint32_t depth = 12;
};

class TensorTest : public MarchTest {
protected:
    std::vector<RayOutput> hits(const TensorGlyph& glyph, const TensorRun& run, const std::vector<RayInput>& rays) {
        std::vector<float> shared = glyph.components;
        shared.push_back(glyph.radius);
        return runFunction<RayOutput>("test_tensor_hit" + std::to_string(glyph.order),
                                      {static_cast<std::uint32_t>(run.method), std::bit_cast<std::uint32_t>(run.step),
                                       run.bisections, run.interpolate ? 1U : 0U, run.adaptive ? 1U : 0U, run.depth},
                                      rays, shared);
    }
};

}  // namespace radiata::test
