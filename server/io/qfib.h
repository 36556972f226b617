// Files of QFib (Mercier et al. 2020, "QFib: Fast and Efficient Brain Tractogram Compression"), for comparison and exchange.
// Little-endian: uint8 version 1, uint32 fibres, float ratio, uint8 quantisation (0 octahedral, 1 spherical Fibonacci), uint8
// bits (8 or 16); then for each fibre two points of three floats, uint16 number of codes, the codes. A code is a direction on
// the sphere; the cap around the last segment with (1 - cos) / 2 <= ratio is mapped onto the whole sphere, all in world axes.
// The step is the distance of the two points.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "model/tractogram.h"

namespace radiata::io {

/// Both quantisations are read. \throws Error(kNotFound, kUnavailable, kCorrupt, kUnsupported)
std::unique_ptr<model::TractogramSource> openQfib(const std::filesystem::path& path);

/// What was written, and how far it is from what was given, by decoding.
struct QfibWritten {
    std::uint64_t fibres = 0, points = 0;
    double mean_um = 0, max_um = 0;
};

/// Writes octahedral codes, with the cap that the authors' program would take.
/// The file keeps one step a fibre, that between its first two points: where others are longer or shorter the errors grow along
/// the fibre (build/even_steps.h). \param open  gives the tractogram from its beginning; called twice
/// \param bits  8 or 16
/// \throws Error(kInvalidArgument) naming the fibre if it has one point, none, or more than 65537; Error(kUnavailable)
QfibWritten writeQfib(const std::function<std::unique_ptr<model::TractogramSource>()>& open, int bits,
                      const std::filesystem::path& path);

/// One fibre, without a file: two points as they are, then codes. \param ratio  of the largest (1 - cos) / 2 and QFib's margin
std::vector<std::uint16_t> encodeQfib(std::span<const glm::vec3> fibre, float ratio, int bits);
std::vector<glm::vec3> decodeQfib(glm::vec3 first, glm::vec3 second, std::span<const std::uint16_t> codes, float ratio,
                                  bool fibonacci, int bits);

/// QFib's ratio for turns of which the smallest cosine is this: with a margin for what quantisation adds.
float qfibRatio(double least_cosine, int bits);

}  // namespace radiata::io
