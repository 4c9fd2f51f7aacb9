#pragma once

#include "qmcf/base/math.hpp"

namespace qmcf {

/// The dihedral angle in radians from which an edge is sharp. featureAngle: degrees, (0, 180). It is less by a
/// ten-thousandth, so that round-off doesn't decide about the twelve sides of a round hole, which turn by exactly 30
/// degrees.
inline double leastSharpAngle(double featureAngle) {
  constexpr double kRoundOff = 1e-4;
  return featureAngle * (1.0 - kRoundOff) * math::kPi / 180.0;
}

}  // namespace qmcf
