#include "tools/lab/experiments.h"

namespace radiata::lab {

const std::vector<Experiment>& experiments() {
    static const std::vector<Experiment> kAll = {
        {"glyph-frame",
         "all passes of a frame of many glyphs, by each traversal; the glyph pass against finding the same boxes", glyphFrame},
        {"march-vs-polynomial",
         "one glyph filling the picture: ns per pixel and wrong pixels of the march and of Peters' solver",
         marchVersusPolynomial},
        {"glyph-pareto", "one glyph by every method and setting: time against error, with the Pareto front", glyphPareto},
    };
    return kAll;
}

}  // namespace radiata::lab
