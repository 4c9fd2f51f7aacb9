#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "qmcf/base/result.hpp"
#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/ids.hpp"

namespace qmcf {

/// An oriented manifold triangle mesh with boundary, as half-edges in flat arrays.
/// Half-edge 3t + c runs from corner c of triangle t to corner (c + 1) % 3. Boundary half-edges have no twin.
/// Every vertex has exactly one fan of triangles: isolated and pinched vertices are refused by build().
class Surface {
 public:
  Surface() = default;

  /// Errors: indexOutOfRange; malformedInput for a repeated corner, a non-manifold or inconsistently oriented edge,
  /// an isolated vertex or a vertex with more than one fan. `elements` are triangle or vertex ids as the message says.
  static Result<Surface> build(std::vector<Vec3> positions, const std::vector<std::array<std::int32_t, 3>>& triangles);

  [[nodiscard]] std::size_t vertexCount() const { return position_.size(); }
  [[nodiscard]] std::size_t halfedgeCount() const { return origin_.size(); }
  [[nodiscard]] std::size_t triangleCount() const { return origin_.size() / 3; }
  [[nodiscard]] IdRange<VertexId> vertices() const { return IdRange<VertexId>(vertexCount()); }
  [[nodiscard]] IdRange<HalfedgeId> halfedges() const { return IdRange<HalfedgeId>(halfedgeCount()); }
  [[nodiscard]] IdRange<TriangleId> triangles() const { return IdRange<TriangleId>(triangleCount()); }

  [[nodiscard]] const Vec3& position(VertexId v) const { return position_[v]; }
  [[nodiscard]] VertexId origin(HalfedgeId h) const { return origin_[h]; }
  [[nodiscard]] VertexId target(HalfedgeId h) const { return origin_[next(h)]; }
  /// The vertex of h's triangle that h does not touch.
  [[nodiscard]] VertexId opposite(HalfedgeId h) const { return origin_[prev(h)]; }
  /// The other half-edge of the edge; invalid on the boundary.
  [[nodiscard]] HalfedgeId twin(HalfedgeId h) const { return twin_[h]; }
  [[nodiscard]] static HalfedgeId next(HalfedgeId h) {
    return HalfedgeId(h.value % 3 == 2 ? h.value - 2 : h.value + 1);
  }
  [[nodiscard]] static HalfedgeId prev(HalfedgeId h) {
    return HalfedgeId(h.value % 3 == 0 ? h.value + 2 : h.value - 1);
  }
  [[nodiscard]] static TriangleId triangle(HalfedgeId h) { return TriangleId(h.value / 3); }
  [[nodiscard]] static HalfedgeId halfedge(TriangleId t, int corner = 0) { return HalfedgeId(3 * t.value + corner); }
  [[nodiscard]] std::array<VertexId, 3> corners(TriangleId t) const {
    return {origin_[halfedge(t, 0)], origin_[halfedge(t, 1)], origin_[halfedge(t, 2)]};
  }
  [[nodiscard]] bool isBoundary(HalfedgeId h) const { return !twin_[h].valid(); }
  [[nodiscard]] bool isBoundary(VertexId v) const { return isBoundary(outgoing_[v]); }

  /// A half-edge leaving v. For a boundary vertex it is the boundary half-edge, from which nextAround visits all
  /// others.
  [[nodiscard]] HalfedgeId outgoing(VertexId v) const { return outgoing_[v]; }
  /// The next outgoing half-edge of the same origin, counter-clockwise; invalid past the last triangle of an open fan.
  [[nodiscard]] HalfedgeId nextAround(HalfedgeId h) const { return twin_[prev(h)]; }
  /// The boundary half-edge after the boundary half-edge h along its loop (the surface lies on its left).
  [[nodiscard]] HalfedgeId nextBoundary(HalfedgeId h) const { return outgoing_[target(h)]; }

  /// Calls visit(HalfedgeId) for each half-edge leaving v, counter-clockwise. In an open fan the last boundary edge is
  /// an incoming one and is not visited.
  template <class Visit>
  void forEachOutgoing(VertexId v, Visit visit) const {
    const HalfedgeId first = outgoing_[v];
    HalfedgeId h = first;
    do {
      visit(h);
      h = nextAround(h);
    } while (h.valid() && h != first);
  }

  /// Twice the area times the unit normal.
  [[nodiscard]] Vec3 areaVector(TriangleId t) const;
  /// Interior angle at the origin of h in its triangle, in radians; 0 in a degenerate triangle.
  [[nodiscard]] double angle(HalfedgeId h) const;
  [[nodiscard]] double length(HalfedgeId h) const { return distance(position_[origin(h)], position_[target(h)]); }
  /// Vertices - edges + triangles.
  [[nodiscard]] std::int64_t eulerCharacteristic() const;
  /// First half-edge of every boundary loop, by smallest half-edge.
  [[nodiscard]] std::vector<HalfedgeId> boundaryLoops() const;

  friend bool operator==(const Surface& a, const Surface& b) = default;

 private:
  IdMap<VertexId, Vec3> position_;
  IdMap<VertexId, HalfedgeId> outgoing_;
  IdMap<HalfedgeId, VertexId> origin_;
  IdMap<HalfedgeId, HalfedgeId> twin_;
};

/// A point of a surface: a triangle and barycentric coordinates that sum to 1.
struct SurfacePoint {
  TriangleId triangle;
  std::array<double, 3> barycentric{1.0, 0.0, 0.0};
};

/// The position in space of a surface point.
Vec3 positionOf(const Surface& surface, const SurfacePoint& point);

}  // namespace qmcf
