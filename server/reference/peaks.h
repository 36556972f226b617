// Peaks of a function on the sphere by dense sampling. Twin of server/build/peaks.h; no derivative is taken.
#pragma once

#include <vector>

#include "model/pick.h"
#include "reference/sh_function.h"

namespace radiata::reference {

/// Local maxima above 0, the largest first; of even layouts both ends. Candidates are samples, 1 degree apart, that no sample
/// within 2.5 degrees exceeds; each is then followed by a compass search with halved steps. Peaks closer together than 2.5
/// degrees may come out as one. |error of a direction| < 1e-3 degrees unless the peak is flatter than 1e-4 of the function's
/// largest curvature.
std::vector<model::Peak> peaks(const ShFunction& f);

}  // namespace radiata::reference
