#pragma once

#include <cmath>

#include "qmcf/base/vec.hpp"

namespace qmcf {

/// Orthonormal coordinates in the tangent plane of a point, counter-clockwise about the normal.
class LocalPlane {
 public:
  LocalPlane(const Vec3& origin, const Vec3& normal) : origin_(origin), normal_(normal) {
    // The coordinate axis that is most orthogonal to the normal gives the first direction.
    const double ax = std::fabs(normal.x);
    const double ay = std::fabs(normal.y);
    const double az = std::fabs(normal.z);
    const Vec3 axis = ax <= ay && ax <= az ? Vec3{1, 0, 0} : ay <= az ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    x_ = normalized(tangentPart(axis, normal));
    y_ = cross(normal, x_);
  }

  [[nodiscard]] Vec2 point(const Vec3& p) const { return vector(p - origin_); }
  [[nodiscard]] Vec2 vector(const Vec3& v) const { return {dot(v, x_), dot(v, y_)}; }
  [[nodiscard]] Vec3 vector(Vec2 v) const { return x_ * v.x + y_ * v.y; }
  [[nodiscard]] const Vec3& normal() const { return normal_; }

 private:
  Vec3 origin_;
  Vec3 normal_;
  Vec3 x_;
  Vec3 y_;
};

/// Twice the signed area of a triangle in the plane.
inline double orient(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); }

/// Twice the signed area of a triangle in space as seen along the normal.
inline double orient(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  return dot(cross(b - a, c - a), normal);
}

}  // namespace qmcf
