// Glyphs and views that experiments share; all deterministic.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/frame.h"
#include "model/sh_image.h"
#include "store/store.h"
#include "tools/lab/experiment.h"

namespace radiata::lab {

/// An image of one voxel.
model::ShImage oneGlyph(ShLayout layout, const std::vector<float>& coefficients);
/// Three crossing fibre lobes with the tails that band limits leave: fODF-like. \param k  even
std::vector<float> fibreLobes(int k);
/// The same lobes without damping and with most of the isotropic part removed: they touch the centre.
std::vector<float> sharpenedLobes(int k);
/// Uniform in [-1, 1], alike in all bands, as Peters et al. 2023 test with.
std::vector<float> uniformGlyph(ShLayout layout, std::uint32_t seed);

/// The image asked for, or a slice of the phantom of at least so many glyphs. \param description  what it is, with its counts
model::ShImage slice(const Options& options, int lmax, std::uint64_t glyphs, std::string& description);

/// One layer of a dataset, all voxels, one sample, no annotations, compute hierarchy.
/// \param both_lobes  |f| is drawn, as Peters et al. do
model::FrameRequest requestOf(const std::string& dataset, int width, int height, bool both_lobes);
/// A dataset of one glyph in absolute scale, seen orthographically so that its sphere fills the picture's height.
/// \param zoom  share of the glyph's radius that is seen, about the centre
model::FrameRequest filledRequest(store::Store& store, const std::string& dataset, int size, double zoom = 1);

}  // namespace radiata::lab
