// The pipelines of fibres in experiments.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/frame.h"

namespace radiata::lab {

/// In the order of tables; `points` and `lines`, which know no fiblets, last.
inline constexpr std::array kFibrePipelines{model::FibletPipeline::kAtomic,   model::FibletPipeline::kPull,
                                            model::FibletPipeline::kMesh,     model::FibletPipeline::kMeshSerial,
                                            model::FibletPipeline::kGeometry, model::FibletPipeline::kTessellation,
                                            model::FibletPipeline::kLines,    model::FibletPipeline::kPoints};

inline std::string nameOf(model::FibletPipeline pipeline) { return std::string(model::pipelineName(pipeline)); }

/// How two pictures differ, over the pixels that show something in either.
struct FibreDifferences {
    std::uint64_t shown = 0;  ///< pixels that show something in either
    std::uint64_t fibre = 0;  ///< that show another fibre, or something in one of the two only
    std::uint64_t alone = 0;  ///< of these: something in one of the two only
    std::uint64_t far = 0;    ///< of `fibre`: whose fibre the other picture does not show within a pixel
    double share(std::uint64_t count) const {
        return shown ? 100.0 * static_cast<double>(count) / static_cast<double>(shown) : 0;
    }
};

/// \param a, b  of each pixel the fibre that is seen, or -1
FibreDifferences compareFibres(const std::vector<std::int32_t>& a, const std::vector<std::int32_t>& b, int width);

/// The fibre of each pixel, or -1.
std::vector<std::int32_t> fibresOf(const model::FramePixels& pixels);

}  // namespace radiata::lab
