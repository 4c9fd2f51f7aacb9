#pragma once

#include <vector>

#include "qmcf/sizing/edge_curve.hpp"

namespace qmcf {

/// How much a curve has turned up to each arc length, in radians: never falls. Wiggles smaller than the tolerance
/// are left out and the turn at a point of a polygon is spread over half of the sides that meet there, so that the
/// result hardly depends on how finely the curve was cut into segments.
struct Turning {
  std::vector<double> arcLength;
  std::vector<double> angle;
  bool closed = false;

  [[nodiscard]] double total() const { return angle.back(); }
  /// Turn within the window of the given width around s. Wraps around on a closed curve.
  [[nodiscard]] double within(double s, double width) const;
};

/// tolerance: length, > 0.
Turning turningOf(const EdgeCurve& curve, double tolerance);

}  // namespace qmcf
