#pragma once

#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/ids.hpp"
#include "qmcf/mesh/surface.hpp"

namespace qmcf {

/// The point of one triangle closest to a query, as barycentric coordinates.
SurfacePoint closestOnTriangle(const Surface& surface, TriangleId triangle, const Vec3& query);

/// Projects a point onto the surface by walking: from the start triangle to ever closer ones through shared vertices.
/// The result is the closest point of a neighbourhood, which is what a step of about one triangle needs; it never jumps
/// to another sheet. Complexity: a few triangles per step; at most 1000 steps.
SurfacePoint walkToClosest(const Surface& surface, TriangleId start, const Vec3& query);

/// Linear interpolation of per-vertex values.
template <class T>
T interpolate(const Surface& surface, const IdMap<VertexId, T>& values, const SurfacePoint& point) {
  const auto corners = surface.corners(point.triangle);
  return values[corners[0]] * point.barycentric[0] + values[corners[1]] * point.barycentric[1] +
         values[corners[2]] * point.barycentric[2];
}

}  // namespace qmcf
