#pragma once

#include "curvature.hpp"
#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "solve.hpp"

namespace qmcf {

/// Removes pairs of singularities of opposite index that lie closer together than `distance` elements, and such further
/// apart whose removal lowers the energy: the turn of the field along the edges between them is changed by a full turn
/// of u, and the crosses around are smoothed with the turns kept. A pair stays where pinned crosses demand it. field:
/// |u| = 1, changed in place. Returns the number of pairs removed. Errors: cancelled.
Result<std::int32_t> cancelPairs(const Patch& patch, const Connection& connection, const FieldMatrices& matrices,
                                 const FieldConditions& conditions, double distance, FieldVector& field,
                                 Progress& progress);

}  // namespace qmcf
