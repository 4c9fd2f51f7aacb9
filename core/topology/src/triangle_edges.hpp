#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "qmcf/mesh/ids.hpp"
#include "qmcf/mesh/surface.hpp"

namespace qmcf::detail {

using EdgeId = Id<struct MeshEdgeTag>;
using Triangles = std::vector<std::array<std::int32_t, 3>>;

/// The undirected edges of a triangle soup, with any number of half-edges on each.
/// Half-edge 3t + c runs from corner c of triangle t to corner (c + 1) % 3, as in Surface. The half-edge also stands
/// for the triangle's corner at its origin. The triangles are referred to, not copied.
class TriangleEdges {
 public:
  /// \pre indices in [0, vertexCount), no repeated corner, 3 * triangles.size() fits an int32.
  TriangleEdges(const Triangles& triangles, std::size_t vertexCount);

  [[nodiscard]] std::size_t vertexCount() const { return vertexCount_; }
  [[nodiscard]] std::size_t edgeCount() const { return ends_.size(); }
  [[nodiscard]] std::size_t halfedgeCount() const { return 3 * triangles_->size(); }
  [[nodiscard]] IdRange<EdgeId> edges() const { return IdRange<EdgeId>(edgeCount()); }
  [[nodiscard]] IdRange<HalfedgeId> halfedges() const { return IdRange<HalfedgeId>(halfedgeCount()); }
  [[nodiscard]] IdRange<TriangleId> triangles() const { return IdRange<TriangleId>(triangles_->size()); }

  [[nodiscard]] VertexId origin(HalfedgeId h) const { return VertexId((*triangles_)[h.index() / 3][h.index() % 3]); }
  [[nodiscard]] VertexId target(HalfedgeId h) const { return origin(Surface::next(h)); }
  [[nodiscard]] EdgeId edge(HalfedgeId h) const { return edge_[h]; }
  /// Smaller vertex first.
  [[nodiscard]] std::array<VertexId, 2> ends(EdgeId e) const { return ends_[e]; }
  [[nodiscard]] VertexId otherEnd(EdgeId e, VertexId v) const { return ends_[e][0] == v ? ends_[e][1] : ends_[e][0]; }
  /// The half-edges on e, ascending.
  [[nodiscard]] std::span<const HalfedgeId> uses(EdgeId e) const {
    return {uses_.data() + firstUse_[e.index()], firstUse_[e.index() + 1] - firstUse_[e.index()]};
  }
  /// Two triangles that run along e in opposite directions.
  [[nodiscard]] bool isManifold(EdgeId e) const {
    const auto u = uses(e);
    return u.size() == 2 && origin(u[0]) != origin(u[1]);
  }
  /// The other half-edge of an edge with two; invalid otherwise.
  [[nodiscard]] HalfedgeId other(HalfedgeId h) const {
    const auto u = uses(edge_[h]);
    if (u.size() != 2) return HalfedgeId();
    return u[0] == h ? u[1] : u[0];
  }

 private:
  const Triangles* triangles_;
  std::size_t vertexCount_;
  IdMap<EdgeId, std::array<VertexId, 2>> ends_;
  std::vector<std::size_t> firstUse_;
  std::vector<HalfedgeId> uses_;
  IdMap<HalfedgeId, EdgeId> edge_;
};

/// The corners of all triangles grouped into fans: two corners at a vertex belong together when an edge between them is
/// not cut (Gueziec et al. 2001: each group becomes a vertex of its own).
struct Fans {
  std::vector<HalfedgeId> first;             ///< Per fan: its first half-edge; an open fan starts at its cut half-edge.
  std::vector<bool> open;                    ///< Per fan: bounded by cut edges.
  IdMap<HalfedgeId, std::int32_t> ofCorner;  ///< Per half-edge: the fan of the corner at its origin.
};

/// \pre every edge that is not cut is manifold.
Fans buildFans(const TriangleEdges& edges, const IdMap<EdgeId, std::uint8_t>& cut);

/// The cut half-edge that follows the cut half-edge h along the boundary of its sheet.
inline HalfedgeId nextCut(const Fans& fans, HalfedgeId h) {
  return fans.first[static_cast<std::size_t>(fans.ofCorner[Surface::next(h)])];
}

/// Lists of edges around vertices, for the edges with keep[e] != 0.
class VertexEdges {
 public:
  VertexEdges(const TriangleEdges& edges, const IdMap<EdgeId, std::uint8_t>& keep);
  /// Ascending.
  [[nodiscard]] std::span<const EdgeId> at(VertexId v) const {
    return {list_.data() + first_[v.index()], first_[v.index() + 1] - first_[v.index()]};
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<EdgeId> list_;
};

}  // namespace qmcf::detail
