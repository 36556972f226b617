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
        {"peters-bounds", "Peters et al. 2023, Sec. 4.2: boxes by search and margin, and certified ones; time per glyph",
         petersBounds},
        {"peters-table1", "Peters et al. 2023, Table 1: 19,600 glyphs by each method, in cylinder boxes and tight ones",
         petersTable1},
        {"peters-fig1", "Peters et al. 2023, Fig. 1: one glyph close by in soft light, and a whole slice", petersFig1},
        {"peters-fig3", "Peters et al. 2023, Fig. 3: roots in the ray parameter and in the turned frame, single precision",
         petersFig3},
        {"peters-fig4", "Peters et al. 2023, Fig. 4: what hard and soft shadows and ambient occlusion add to the glyph passes",
         petersFig4},
        {"peters-fig5", "Peters et al. 2023, Fig. 5: what uncertainty adds to the glyph passes, in whole and in a close-up",
         petersFig5},
        {"peters-fig6", "Peters et al. 2023, Fig. 6: what the number of steps of ray marching does to small features",
         petersFig6},
        {"peters-fig7", "Peters et al. 2023, Fig. 7: one glyph truncated at bands 2 to 16", petersFig7},
        {"hlawitschka-table1", "Hlawitschka et al., Table 1: frames per second over step and refinement", hlawitschkaTable1},
        {"hlawitschka-table2", "Hlawitschka et al., Table 2: grids of triangles against ray casting, 258 glyphs",
         hlawitschkaTable2},
        {"hlawitschka-fig1", "Hlawitschka et al., Fig. 1: error over step and refinement, two glyphs", hlawitschkaFig1},
        {"hlawitschka-fig2", "Hlawitschka et al., Fig. 2: the gap at the centre and what closes it", hlawitschkaFig2},
        {"hlawitschka-fig5", "Hlawitschka et al., Fig. 5: colour codings, their cost in the light pass and their exactness",
         hlawitschkaFig5},
        {"isosurface-hits", "the cubic on four million chords; primary rays with and without bricks, exact and marched",
         isosurfaceHits},
        {"wyman-fig5", "Wyman et al. 2006, Fig. 5: normals of the trilinear cell and of the smoothing spline", wymanFig5},
        {"wyman-table2", "Wyman et al. 2006, Table 2: frames with ready texels, with no shadows and with shadow rays",
         wymanTable2},
        {"wyman-fig6", "Wyman et al. 2006, Fig. 6: error by the texels that light a point", wymanFig6},
        {"wyman-fig7", "Wyman et al. 2006, Fig. 7: error by samples per texel, of irradiance and of transfer", wymanFig7},
        {"wyman-fig12", "Wyman et al. 2006, Fig. 12: error by resolution of the lattice; texels on the shown surface",
         wymanFig12},
        {"illumination-pareto", "globally lit isosurfaces: time for texels against error", illuminationPareto},
        {"fiblet-codec", "fiblets: bytes a point, errors and encoding speed by width of the search, bits and bound",
         fibletCodec},
        {"schertzer-table1", "Schertzer et al. 2022, Table 1: sizes and errors of fiblets, the paper's layout and QFib",
         schertzerTable1},
        {"schertzer-fig9",
         "Schertzer et al. 2022, Fig. 9: what the coverage buffer culls wrongly after turns of up to 60 degrees",
         schertzerFig9},
        {"fiblet-scaling", "frames of fibres over their number, culled and not, in a turn of 1.14 degrees a frame",
         fibletScaling},
    };
    return kAll;
}

}  // namespace radiata::lab
