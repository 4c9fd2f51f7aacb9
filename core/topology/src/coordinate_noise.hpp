#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "qmcf/base/bounding_box.hpp"

namespace qmcf::detail {

/// The resolution of the coordinates: of single precision when all of them are such numbers, else of double precision.
inline double coordinateResolution(const std::vector<Vec3>& positions, const BoundingBox& box) {
  bool single = true;
  for (const Vec3& p : positions) {
    for (const double x : {p.x, p.y, p.z}) single = single && static_cast<double>(static_cast<float>(x)) == x;
  }
  const double epsilon =
      single ? static_cast<double>(std::numeric_limits<float>::epsilon()) : std::numeric_limits<double>::epsilon();
  return epsilon * box.largestCoordinate();
}

}  // namespace qmcf::detail
