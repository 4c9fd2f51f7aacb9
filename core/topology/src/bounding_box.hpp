#pragma once

#include <cmath>
#include <limits>

#include "qmcf/base/vec.hpp"

namespace qmcf::detail {

/// Axis-aligned box around points.
struct BoundingBox {
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec3 low{kFar, kFar, kFar};
  Vec3 high{-kFar, -kFar, -kFar};

  void include(const Vec3& p) {
    low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
    high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
  }
  /// \pre not empty.
  [[nodiscard]] double diagonal() const { return distance(low, high); }
  [[nodiscard]] double largestCoordinate() const {
    return std::fmax(std::fmax(std::fmax(-low.x, high.x), std::fmax(-low.y, high.y)), std::fmax(-low.z, high.z));
  }
  [[nodiscard]] bool contains(const BoundingBox& other) const {
    return low.x <= other.low.x && low.y <= other.low.y && low.z <= other.low.z && high.x >= other.high.x &&
           high.y >= other.high.y && high.z >= other.high.z;
  }
};

}  // namespace qmcf::detail
