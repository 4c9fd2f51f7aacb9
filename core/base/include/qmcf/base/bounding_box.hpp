#pragma once

#include <cmath>
#include <limits>

#include "qmcf/base/vec.hpp"

namespace qmcf {

/// Axis-aligned box around points.
struct BoundingBox {
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec3 low{kFar, kFar, kFar};
  Vec3 high{-kFar, -kFar, -kFar};

  void include(const Vec3& p) {
    low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
    high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
  }
  /// Makes it larger by the margin on all sides.
  void widen(double margin) {
    const Vec3 around{margin, margin, margin};
    low = low - around;
    high = high + around;
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
  /// Whether they have a point in common.
  [[nodiscard]] bool meets(const BoundingBox& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y &&
           low.z <= other.high.z && other.low.z <= high.z;
  }
};

}  // namespace qmcf
