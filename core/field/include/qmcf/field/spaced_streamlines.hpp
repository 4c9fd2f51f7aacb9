#pragma once

#include <vector>

#include "qmcf/field/streamline.hpp"
#include "qmcf/mesh/patch.hpp"

namespace qmcf {

struct SpacedStreamlinesOptions {
  double spacing = 2.0;               ///< Between neighbouring lines where they start, in elements, > 0.
  double closest = 0.5;               ///< A line ends where another of its direction is nearer than this many spacings.
  double shortest = 2.0;              ///< Shorter lines are left out, in spacings; >= 0.
  double leastConfidence = 0.05;      ///< As StreamlineOptions::leastConfidence.
  std::int32_t mostTriangles = 4000;  ///< That one line may cross in either direction, >= 1.
};

/// Streamlines that cover the patch evenly, both families of each cross, to look at (after Jobard and Lefer, "Creating
/// evenly-spaced streamlines of arbitrary density", 1997). A line that runs around closes once. Deterministic; in the
/// order in which they were found. Complexity: O(triangles crossed times triangles within one spacing).
std::vector<Streamline> spacedStreamlines(const Patch& patch, const CrossField& field,
                                          const SpacedStreamlinesOptions& options);

}  // namespace qmcf
