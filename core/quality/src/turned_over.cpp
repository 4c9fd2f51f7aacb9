#include "qmcf/quality/turned_over.hpp"

#include <algorithm>
#include <cmath>

namespace qmcf {
namespace {

/// Of the way from a corner to the element's centre: where its patch is looked for.
constexpr double kCornerInset = 0.25;
/// Of the square root of the element's area, beyond the distance to the patch.
constexpr double kPatchReach = 0.1;
/// Barycentric coordinate of a point on an edge of the surface; difference of equal distances, in units of themselves
/// and of the square root of the element's area.
constexpr double kOnEdge = 1e-9;
/// What is turned over is so by no less than this.
constexpr double kLeast = 1e-3;
constexpr double kSmallest = 1e-300;

}  // namespace

double turnedOverBy(const TriangleBvh& surface, const std::array<Vec3, 4>& corners, std::size_t count,
                    const ClosestPoint& below) {
  const auto at = [&](std::size_t corner) -> const Vec3& { return corners[corner % count]; };
  Vec3 centre;
  for (std::size_t c = 0; c < count; ++c) centre += at(c);
  centre = centre / static_cast<double>(count);
  double area = 0.0;
  for (std::size_t c = 0; c < count; ++c) area += 0.5 * norm(cross(at(c) - centre, at(c + 1) - centre));
  const double side = std::sqrt(area);
  const Vec3& under = surface.normal(below.triangle);
  // Where the point below the centre is on an edge of the surface, none of the triangles there is nearer than another.
  const bool isOnEdge = *std::min_element(below.barycentric.begin(), below.barycentric.end()) <= kOnEdge;
  const double tied = std::sqrt(below.squaredDistance) * (1.0 + kOnEdge) + kOnEdge * side;
  double most = 0.0;
  for (std::size_t c = 0; c < count; ++c) {
    const Vec3 normal = cross(at(c + 1) - at(c), at(c + count - 1) - at(c));
    if (dot(normal, under) >= 0.0 && !(isOnEdge && surface.isAnyFacing(-normal, centre, tied))) continue;
    const Vec3 point = at(c) + (centre - at(c)) * kCornerInset;
    const double reach = std::sqrt(surface.closest(point, below.triangle).squaredDistance) + kPatchReach * side;
    if (surface.isAnyFacing(normal, point, reach)) continue;
    const Vec3 unit = normalized(normal);
    const ClosestPoint agreeing = surface.closestFacing(normal, point, reach + side);
    const double beyond =
        agreeing.triangle >= 0 ? (std::sqrt(agreeing.squaredDistance) - reach) / std::max(side, kSmallest) : 1.0;
    const ClosestPoint opposing = surface.closestFacing(-normal, centre, tied);
    const Vec3& opposed = opposing.triangle >= 0 ? surface.normal(opposing.triangle) : under;
    most = std::max(most, std::clamp(std::min(beyond, -dot(unit, opposed)), kLeast, 1.0));
  }
  return most;
}

}  // namespace qmcf
