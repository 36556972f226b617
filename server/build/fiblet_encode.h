// From streamlines to fiblets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "base/error.h"
#include "build/fiblet_measure.h"
#include "build/fibre_strays.h"
#include "model/fiblet_set.h"
#include "model/tractogram.h"

namespace radiata {

struct FibletOptions {
    double bound_um = 10;           ///< largest distance between a point and its decoded one, above 0
    double walk_bound_um = 100;     ///< if steps vary: largest distance between a point and the line that is encoded
    double step_mm = 0;             ///< of all segments but each fibre's last; 0: to be chosen
    std::uint32_t beam = 8;         ///< beginnings kept while searching, up to 64; 0: none, each code the nearest to its aim
    std::uint32_t least_width = 4;  ///< bits per point at least: 4, 6, 8 or 16
    /// Steps that are constant may be walked with smaller ones where the bound cannot be held with the points as they are.
    bool walk_rather = false;
    double longest_step_mm = std::numeric_limits<double>::infinity();  ///< of those to choose from
    /// Fibres with a point farther than this from the middle of the fibres are left out, but keep their numbers.
    double within_mm = std::numeric_limits<double>::infinity();
    /// A few fibres so far out that places cannot be kept within the bound are left out, rather than refuse all.
    bool leave_strays = false;
};

/// What all fiblets of a tractogram share, and how it is walked.
struct FibletPlan {
    model::FibletSet set;     ///< codec, origin, bound, source and what the walk costs; nothing else
    double walk_step_mm = 0;  ///< 0: points stay
};

/// No codes of these steps hold the bound; those of smaller ones may.
class UnheldBound : public Error {
public:
    UnheldBound(const std::string& message, double step_mm, bool walked)
        : Error(Code::kInvalidArgument, message), step_mm_(step_mm), walked_(walked) {}
    double stepMm() const { return step_mm_; }
    bool walked() const { return walked_; }

private:
    double step_mm_;
    bool walked_;
};

/// Calls encode(options), and where that meets UnheldBound with a step that was free to choose, again with steps of half that
/// length at most; a turn between chords takes its place in a code by the angle, and its error grows with the chord.
/// \param finer  told what could not be held, before each further attempt; six at most, then the error is the last one's
template <class Encode, class Finer>
auto encodeWithFinerSteps(FibletOptions options, const Encode& encode, const Finer& finer) {
    for (int left = 6;; --left) {
        try {
            return encode(options);
        } catch (const UnheldBound& unheld) {
            const bool free = options.step_mm == 0 && (unheld.walked() || options.walk_rather);
            if (left == 0 || !free) throw;
            finer(unheld);
            options.longest_step_mm = 0.5 * unheld.stepMm();
        }
    }
}

/// Calls encode(open), with fibres beyond options.within_mm left out; or where that meets StrayFibres, and
/// options.leave_strays, again without those. \param left_out  told why, before the second attempt
template <class Encode, class LeftOut>
auto encodeWithoutStrays(const OpenTractogram& open, const FibletOptions& options, std::size_t batch_points,
                         const Encode& encode, const LeftOut& left_out) {
    const auto within = [&](const FibreBall& ball) -> OpenTractogram {
        return [&open, ball] { return fibresWithin(open(), ball); };
    };
    if (options.within_mm < std::numeric_limits<double>::infinity()) {
        return encode(within({middleOfFibres(*open(), batch_points), options.within_mm}));
    }
    FibreBall others;
    try {
        return encode(open);
    } catch (const StrayFibres& strays) {
        if (!options.leave_strays || !strays.few()) throw;
        left_out(strays);
        others = strays.others();
    }
    return encode(within(others));
}

/// Reads the tractogram once, or twice if its steps vary. \param batch_points  that are in memory at once, about
FibletPlan planFiblets(const OpenTractogram& open, const FibletOptions& options, std::size_t batch_points,
                       const FibletProgress& progress);

/// Hands out a tractogram in batches, reading one while the other is worked on, until `take` returns false.
/// \return whether all was taken
bool readFibreBatches(model::TractogramSource& source, std::size_t points,
                      const std::function<bool(const model::FibreBatch&)>& take, const FibletProgress& progress);

/// Encodes a tractogram in memory; ingest/fiblet_conversion.h makes files of such as do not fit. Fibres whose segments all have
/// one length, but for each fibre's last, which may be shorter, keep their points; others are walked (build/fiblet_walk.h),
/// with a step for which codes hold the bound. Fibres without points stay without fiblets and keep their numbers. Equal input
/// gives equal bytes, whatever the number of threads. \param open  gives the tractogram from its beginning; called two or three
/// times \throws Error(kInvalidArgument) naming the fibre if a bound cannot be held or a fibre has more than 63 * 4096
/// segments; and as the
///         source
model::FibletSet encodeFiblets(const OpenTractogram& open, const FibletOptions& options, const FibletProgress& progress = {});

/// The same of a tractogram in memory.
model::FibletSet encodeFiblets(const model::Tractogram& tractogram, const FibletOptions& options);

/// The same of points. \param offsets  fibre f has the points [offsets[f], offsets[f + 1]), maybe none
model::FibletSet encodeFiblets(std::span<const glm::vec3> points, std::span<const std::uint64_t> offsets,
                               const FibletOptions& options);

}  // namespace radiata
