#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/ids.hpp"

namespace qmcf {

/// What may happen to a vertex of a RemeshMesh.
enum class VertexRole : std::uint8_t {
  interior,  ///< Moves and goes as need be.
  point,     ///< On the boundary, to be removed along it.
  node,      ///< On the boundary, stays.
};

/// An oriented manifold triangle mesh with boundary whose edges can be split, collapsed and flipped.
/// Half-edges as in Surface: 3t + c runs from corner c of triangle t to corner c + 1; boundary ones have no twin; the
/// outgoing half-edge of a boundary vertex is its boundary half-edge. Removed elements keep their ids.
class RemeshMesh {
 public:
  std::vector<Vec3> position;
  std::vector<Vec3> normal;  ///< Per vertex: unit normal of the smooth surface.
  std::vector<VertexRole> role;
  std::vector<std::int32_t> node;      ///< Per vertex: id of the shared node; kNone for other vertices.
  std::vector<std::int32_t> triangle;  ///< Per vertex: reference triangle it lies on; kNone when not known.

  /// \pre the triangles make an oriented manifold; position is filled.
  void build(const std::vector<std::array<std::int32_t, 3>>& triangles, const std::vector<std::int32_t>& twins);

  /// Gives all elements new ids without gaps, neighbours near each other, so that a walk over the mesh stays in the
  /// cache: breadth first from the boundary, loop by loop. Returns the new id of each vertex; kNone of removed ones.
  std::vector<std::int32_t> renumber();

  [[nodiscard]] std::int32_t halfedgeCount() const { return static_cast<std::int32_t>(origin_.size()); }
  [[nodiscard]] std::int32_t vertexCount() const { return static_cast<std::int32_t>(outgoing_.size()); }
  [[nodiscard]] bool isRemoved(std::int32_t h) const { return at(origin_, h) == kNone; }
  [[nodiscard]] bool isVertexRemoved(std::int32_t v) const { return at(outgoing_, v) == kNone; }
  [[nodiscard]] static std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  [[nodiscard]] static std::int32_t prev(std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  [[nodiscard]] std::int32_t origin(std::int32_t h) const { return at(origin_, h); }
  [[nodiscard]] std::int32_t target(std::int32_t h) const { return at(origin_, next(h)); }
  [[nodiscard]] std::int32_t apex(std::int32_t h) const { return at(origin_, prev(h)); }
  [[nodiscard]] std::int32_t twin(std::int32_t h) const { return at(twin_, h); }
  [[nodiscard]] std::int32_t outgoing(std::int32_t v) const { return at(outgoing_, v); }
  [[nodiscard]] bool onBoundary(std::int32_t v) const { return at(twin_, at(outgoing_, v)) == kNone; }
  [[nodiscard]] const Vec3& positionOf(std::int32_t v) const { return position[static_cast<std::size_t>(v)]; }
  [[nodiscard]] double length(std::int32_t h) const { return distance(positionOf(origin(h)), positionOf(target(h))); }
  /// Mark of a boundary half-edge, kept by all operations; kNone on others.
  [[nodiscard]] std::int32_t mark(std::int32_t h) const { return at(mark_, h); }
  void setMark(std::int32_t h, std::int32_t mark) { at(mark_, h) = mark; }
  /// The boundary half-edge that ends at a boundary vertex.
  [[nodiscard]] std::int32_t incomingBoundary(std::int32_t v) const;

  /// Calls visit(half-edge) for each half-edge leaving v, counter-clockwise.
  template <class Visit>
  void forEachOutgoing(std::int32_t v, Visit visit) const {
    const std::int32_t first = outgoing(v);
    std::int32_t h = first;
    do {
      visit(h);
      h = twin(prev(h));
    } while (h != kNone && h != first);
  }

  /// Calls visit(vertex) for each neighbour of v.
  template <class Visit>
  void forEachNeighbor(std::int32_t v, Visit visit) const {
    const std::int32_t first = outgoing(v);
    std::int32_t h = first;
    while (true) {
      visit(target(h));
      const std::int32_t last = prev(h);
      h = twin(last);
      if (h == first) return;
      if (h == kNone) {
        visit(origin(last));
        return;
      }
    }
  }

  /// Whether v has so many neighbours; no more than these are counted.
  [[nodiscard]] bool hasNeighbors(std::int32_t v, int count) const;
  [[nodiscard]] bool areNeighbors(std::int32_t a, std::int32_t b) const;

  /// Puts a new vertex on an edge; h keeps its origin and then ends at the new vertex. Attributes are left at defaults.
  std::int32_t split(std::int32_t h, const Vec3& where);

  /// Whether h has two triangles and the edge across them does not exist yet.
  [[nodiscard]] bool canFlip(std::int32_t h) const;
  /// Turns the edge within its two triangles. \pre canFlip(h)
  void flip(std::int32_t h);

  /// Whether the edge of h can shrink to a point and leave a manifold of the same topology (link condition), given that
  /// the vertex `removed`, one of its ends, disappears. Nodes never do; points only along the boundary.
  [[nodiscard]] bool canCollapse(std::int32_t h, std::int32_t removed);
  /// Moves all edges of `removed` to the other end of h. \pre canCollapse(h, removed)
  void collapse(std::int32_t h, std::int32_t removed);

 private:
  template <class T>
  static T& at(std::vector<T>& v, std::int32_t i) {
    return v[static_cast<std::size_t>(i)];
  }
  template <class T>
  static const T& at(const std::vector<T>& v, std::int32_t i) {
    return v[static_cast<std::size_t>(i)];
  }

  void reorder(const std::vector<std::int32_t>& vertices, const std::vector<std::int32_t>& triangles,
               const std::vector<std::int32_t>& newVertex, const std::vector<std::int32_t>& newTriangle);
  std::int32_t addTriangle();
  void pair(std::int32_t a, std::int32_t b);
  void hand(std::int32_t from, std::int32_t to);
  void settle(std::int32_t v, std::int32_t anyOutgoing);
  std::int32_t closeTriangle(std::int32_t h);

  std::vector<std::int32_t> origin_;
  std::vector<std::int32_t> twin_;
  std::vector<std::int32_t> mark_;
  std::vector<std::int32_t> outgoing_;
  std::vector<std::int32_t> stamp_;  ///< Per vertex: the last visit that saw it.
  std::int32_t visit_ = 0;
};

}  // namespace qmcf
