// One view by several methods, as a table of times and errors and as plots of error against time.
#pragma once

#include <string>
#include <vector>

#include "tools/lab/accuracy.h"
#include "tools/lab/measure.h"
#include "tools/lab/method.h"
#include "tools/lab/report.h"

namespace radiata::lab {

struct Comparison {
    std::vector<Measured> measured;
    std::vector<Errors> errors;  ///< one for each of `measured`

    double medianMs(std::size_t i) const { return measured[i].time.median(); }
    /// Median of the candidate whose name is this; \throws Error(kInternal) if none is
    double medianMs(const std::string& name) const;
    const Errors& errorsOf(const std::string& name) const;
    bool has(const std::string& name) const;
    /// The fastest of those whose names begin so and that draw no wrong pixel; if all draw some, the one with fewest.
    std::size_t best(const std::string& beginning) const;
};

/// The request by each method, in this order.
std::vector<Candidate> candidatesOf(const model::FrameRequest& request, const std::vector<Method>& methods);

/// Measures all and adds to the report: a table `view`, and plots of the share of wrong pixels and of the depth error (99 of
/// 100 pixels) against time, with the Pareto front.
/// \param truth   the scene that all candidates draw, as glyphs of spherical harmonics
/// \param sample  pixels that the double-precision reference looks at, about
Comparison compareMethods(Report& report, render::Renderer& renderer, store::Store& store, const std::string& view,
                          const std::vector<Candidate>& candidates, const model::FrameRequest& truth, int sample);

/// What the columns of those tables mean, for the report's notes.
std::string comparisonNote();

}  // namespace radiata::lab
