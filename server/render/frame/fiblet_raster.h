// Fiblets by the compute shader of raster.comp: words of pixels begin as what is there, fiblets are drawn into them, and what
// they won goes to a surface buffer.
#pragma once

#include <cstdint>

#include "render/frame/fiblet_run.h"

namespace radiata::render {

/// What words are for.
struct FibletUse {
    /// Of each pixel, so many of the nearest segments that are not composed yet, of a transparent layer; 0: the nearest
    std::uint32_t chain = 0;
    bool peeling = false;   ///< some are composed
    bool counting = false;  ///< segments before what is opaque are counted
    bool finding = false;   ///< fibres in an outline are noted, nothing is drawn
};

class FibletRaster {
public:
    explicit FibletRaster(FibletRun& layer) : layer_(layer), run_(layer.run), plan_(layer.plan), own_(layer.own) {}

    FibletUse use;

    /// Whether lines are drawn so too, not only tubes: transparent layers and outlines are for this pipeline alone.
    bool drawsLines() const { return use.chain != 0 || use.finding || plan_.pipeline == model::FibletPipeline::kAtomic; }
    /// \param empty  nothing that was drawn before is looked at
    void begin(bool empty);
    /// Fiblets [first, end) of the list, or of all, in bounded submissions: what no other pipeline draws of them.
    void draw(bool listed, std::uint32_t first, std::uint32_t end);

    struct Resolve {
        bool marks = false;       ///< who is seen, for the next picture
        bool counts = false;      ///< pixels that show something
        bool marks_only = false;  ///< the surface buffer is left alone
    };
    /// To the target's surface buffer, or lit to the picture (fibre_light.h). \return  fiblets that are listed anew, as others
    /// have overwritten their tangents; a second drawing finds the final words
    std::uint32_t resolve(const Resolve& how);
    /// Of chains, the nearest segments that are not composed yet to the target's peel surface. \param slot  how often it was
    /// done since they were drawn \return  as resolve() does
    std::uint32_t resolveSheet(std::uint32_t slot);

private:
    void toSurface(const Resolve& how);
    std::uint32_t takeRepaired();

    FibletRun& layer_;
    PassRun& run_;
    const plan::FibletPlan& plan_;
    FibletBuffers& own_;
};

}  // namespace radiata::render
