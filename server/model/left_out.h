// What a layer does not show of its dataset beside what its selection leaves out: bands, voxels, glyphs, pages of fibres; and
// global light that no layer takes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace radiata::model {

struct LeftOut {
    int layer = 0;                           ///< of the scene
    int lmax = 0, lmax_available = 0;        ///< highest band that is drawn, and of the dataset
    std::uint64_t voxels_not_finite = 0;     ///< of the whole dataset: a coefficient is NaN or infinite
    std::uint64_t glyphs_out_of_range = 0;   ///< selected, and too large or too small for float32
    std::uint64_t glyphs_without_lobes = 0;  ///< selected, and without a lobe that is shown
    /// Of fibres that are not all on the device: pages that can be seen, and those of them of which a subset is shown.
    std::uint64_t fiblet_pages = 0, fiblet_pages_left_out = 0;
    bool global_light = false;  ///< was asked for, and no layer takes it
    bool anything() const {
        return lmax < lmax_available || global_light ||
               voxels_not_finite + glyphs_out_of_range + glyphs_without_lobes + fiblet_pages_left_out > 0;
    }
    bool operator==(const LeftOut&) const = default;
};

/// In words, one text for each thing that is left out. ASCII, for pictures. \param names_layer  as scenes of several need
std::vector<std::string> leftOutTexts(const LeftOut& left_out, bool names_layer);

}  // namespace radiata::model
