#include "model/left_out.h"

namespace radiata::model {
namespace {

std::string counted(std::uint64_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

std::vector<std::string> leftOutTexts(const LeftOut& left_out, bool names_layer) {
    const std::string layer = names_layer ? "layer " + std::to_string(left_out.layer) + ": " : "";
    std::vector<std::string> texts;
    if (left_out.lmax < left_out.lmax_available) {
        texts.push_back(layer + "bands to " + std::to_string(left_out.lmax) + " of " + std::to_string(left_out.lmax_available) +
                        " drawn");
    }
    if (left_out.glyphs_out_of_range > 0) {
        texts.push_back(layer + counted(left_out.glyphs_out_of_range, "glyph") + " left out: too large or small for float32");
    }
    if (left_out.voxels_not_finite > 0) {
        texts.push_back(layer + counted(left_out.voxels_not_finite, "voxel") + " left out: NaN or infinity");
    }
    if (left_out.glyphs_without_lobes > 0) {
        texts.push_back(layer + counted(left_out.glyphs_without_lobes, "glyph") + " left out: no lobe to show");
    }
    if (left_out.fiblet_pages_left_out > 0) {
        texts.push_back(layer + "subset of fibres in " + std::to_string(left_out.fiblet_pages_left_out) + " of " +
                        std::to_string(left_out.fiblet_pages) + " pages: beyond the memory for fibres");
    }
    if (left_out.global_light) {
        texts.push_back(layer + "no global light: only opaque isosurfaces without a shading of their own take it");
    }
    return texts;
}

}  // namespace radiata::model
