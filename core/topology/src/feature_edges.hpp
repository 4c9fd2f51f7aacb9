#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bodies.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/topology/brep.hpp"
#include "triangle_edges.hpp"

namespace qmcf::detail {

/// What each mesh edge is.
struct FeatureEdges {
  /// 0 for an edge inside a face; 1 + EdgeKind for one that cuts.
  IdMap<EdgeId, std::uint8_t> mark;
  /// Angle between the normals of a manifold edge's triangles in radians, 0 elsewhere.
  IdMap<EdgeId, double> dihedral;
  /// Per vertex of the mesh: 1 where other than two cutting edges met before chains were cleaned, without those
  /// whose angle is unknown. Empty before that.
  std::vector<std::uint8_t> junction;

  [[nodiscard]] bool is(EdgeId e, EdgeKind kind) const { return mark[e] == 1 + static_cast<std::uint8_t>(kind); }
  void set(EdgeId e, EdgeKind kind) { mark[e] = static_cast<std::uint8_t>(1 + static_cast<std::uint8_t>(kind)); }
  [[nodiscard]] EdgeKind kind(EdgeId e) const { return static_cast<EdgeKind>(mark[e] - 1); }
};

using FlatEdges = std::vector<std::array<std::int32_t, 2>>;

/// Marks boundary, non-manifold, sharp and label edges one by one. featureAngle in radians.
FeatureEdges markFeatureEdges(const TriangleMesh& mesh, const TriangleEdges& edges, double featureAngle);

/// Cleans the sharp chains of each body (connected component), with lengths relative to the body:
/// chains that end inside a face are continued along weaker edges where that leads to another edge; short chains that
/// still end inside a face are dropped. In a body whose sharp edges are scattered instead of forming chains (a scan, a
/// sculpted model) the tessellation of high curvature was mistaken for creases: only edges of twice the angle count
/// there, and small patches between them are joined to their neighbours.
/// featureAngle in radians, as given to markFeatureEdges(). flat: BrepOptions::flatEdges. Returns, per body, whether it
/// is such a scattered one.
std::vector<std::uint8_t> cleanFeatureChains(const TriangleMesh& mesh, const TriangleEdges& edges, const Bodies& bodies,
                                             double featureAngle, const FlatEdges& flat, FeatureEdges& features);

}  // namespace qmcf::detail
