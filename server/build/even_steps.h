// Fibres of varying steps for files that keep one step a fibre and no shorter last one, such as QFib's: each gets points a
// constant step apart as the crow flies along its line, its own step, with which the last falls on the line's end.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "build/fiblet_walk.h"
#include "model/fiblet_set.h"
#include "model/tractogram.h"

namespace radiata {

struct EvenStepWish {
    double step_mm = 0;      ///< about; 0: the fibre's mean segment, or less where the bound needs it
    double bound_um = 100;   ///< of the vertices' distances from the new line
    std::uint64_t most = 0;  ///< points that a fibre may have
};

/// What was done so far.
struct EvenStepTally {
    std::uint64_t walked = 0;    ///< fibres
    model::FibletErrors errors;  ///< of their points against the new lines
    std::string remarks;         ///< of the source, once it is read
};

/// Whether all segments are as long as the first, within 1 %, what rounding does to coordinates, and 50 um over the fibre.
bool hasEvenSteps(std::span<const glm::vec3> fibre);

/// \return false if no step holds the bound. The steps are alike within 1e-3 and what rounding does.
bool walkEvenly(std::span<const glm::vec3> fibre, const EvenStepWish& wish, Walk& out);

/// Hands out fibres with even steps as they are and others walked, without columns.
class EvenSteps : public model::TractogramSource {
public:
    /// \param tally  outlives this; set to nothing now
    EvenSteps(std::unique_ptr<model::TractogramSource> source, const EvenStepWish& wish, EvenStepTally& tally);

    const model::TractogramHeader& header() const override { return header_; }
    /// \throws Error(kInvalidArgument) naming the fibre that cannot be walked within the bound; and as the source
    bool read(model::FibreBatch& batch, std::size_t points_wanted) override;
    std::vector<model::FibreGroup> groups() override { return source_->groups(); }
    std::uint64_t damagedFibres() const override { return source_->damagedFibres(); }
    std::uint64_t bytesRead() const override { return source_->bytesRead(); }
    std::uint64_t bytesTotal() const override { return source_->bytesTotal(); }

private:
    std::unique_ptr<model::TractogramSource> source_;
    EvenStepWish wish_;
    model::TractogramHeader header_;
    model::FibreBatch own_;
    EvenStepTally& tally_;
    std::uint64_t point_ = 0;
    double sum_mm_ = 0;
};

}  // namespace radiata
