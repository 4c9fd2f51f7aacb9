#pragma once

#include <cstdint>

#include "node_places.hpp"

namespace qmcf {

/// One edge on its way to whole divisions.
struct EdgePlan : PlacedCurve {
  std::int32_t least = 1;
  std::int32_t count = 1;
  bool asGiven = false;  ///< The curve's own points are the nodes.
};

}  // namespace qmcf
