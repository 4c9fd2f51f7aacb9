#pragma once

#include "qmcf/base/math.hpp"
#include "qmcf/field/connection.hpp"

namespace qmcf {

/// Direction of a half-edge in its triangle's own frame, whose x axis runs along the first half-edge.
inline double directionInTriangle(const Connection& connection, HalfedgeId h) {
  switch (h.value % 3) {
    case 1:
      return math::kPi - connection.corner[h];
    case 2:
      return math::kPi + connection.corner[Surface::next(h)];
    default:
      return 0.0;
  }
}

/// The angle to add to a direction at h's origin to have it in the frame of h's triangle. Scaled and plain angles of
/// the corner agree at the given share of it: 0 along h, 1 along the corner's other edge.
inline double cornerTurn(const Connection& connection, HalfedgeId h, double share) {
  return directionInTriangle(connection, h) + share * connection.corner[h] - connection.angle[h] -
         share * connection.scaled[h];
}

}  // namespace qmcf
