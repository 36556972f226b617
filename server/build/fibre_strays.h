// Fibres far from all others. One such fibre stretches the cells in which a .fiblet file keeps places (2^20 along the longest
// side of the box of all points) until they are wider than the bound of the error; so it is found, named and, if asked for,
// left out.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include <glm/glm.hpp>

#include "base/error.h"
#include "build/fiblet_measure.h"
#include "model/tractogram.h"

namespace radiata {

/// A ball around where most fibres are.
struct FibreBall {
    glm::dvec3 middle_mm{0};  ///< world mm
    double radius_mm = 0;
};

/// Cells are too wide for the bound.
class StrayFibres : public Error {
public:
    StrayFibres(const std::string& message, const FibreBall& others, std::uint64_t strays, std::uint64_t fibres)
        : Error(Code::kInvalidArgument, message), others_(others), strays_(strays), fibres_(fibres) {}
    /// That holds all others, and whose cells hold the bound.
    const FibreBall& others() const { return others_; }
    /// One, or at most a hundredth of all: to be left out rather than to refuse the rest.
    bool few() const { return strays_ > 0 && strays_ <= std::max<std::uint64_t>(1, fibres_ / 100); }

private:
    FibreBall others_;
    std::uint64_t strays_, fibres_;
};

/// Side of the cells for points in a box of this size, mm.
double fibletCellMm(const glm::dvec3& size_mm);

/// The median of the first points along each axis, of up to 65536 fibres evenly taken; world mm, 0 without points.
glm::dvec3 middleOfFibres(model::TractogramSource& source, std::size_t batch_points);

/// \throws StrayFibres naming the farthest fibre, its place and what would work, if the extent of the points needs cells that
///         cannot hold the bound; the fibres are read twice more then
void requireNarrowCells(const OpenTractogram& open, const model::TractogramMeasures& measures, double bound_um,
                        std::size_t batch_points);

/// The same fibres; those with a point outside of the ball have none, but keep their numbers. What was left out is among the
/// header's remarks once all are read.
std::unique_ptr<model::TractogramSource> fibresWithin(std::unique_ptr<model::TractogramSource> source, const FibreBall& ball);

/// What was assumed about a tractogram that was read to its end, and how many fibres are left out of it, as sentences.
std::string remarksOf(const model::TractogramSource& source);

}  // namespace radiata
