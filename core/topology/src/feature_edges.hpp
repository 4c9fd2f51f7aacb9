#pragma once

#include <cstdint>
#include <vector>

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

  [[nodiscard]] bool is(EdgeId e, EdgeKind kind) const { return mark[e] == 1 + static_cast<std::uint8_t>(kind); }
  void set(EdgeId e, EdgeKind kind) { mark[e] = static_cast<std::uint8_t>(1 + static_cast<std::uint8_t>(kind)); }
  [[nodiscard]] EdgeKind kind(EdgeId e) const { return static_cast<EdgeKind>(mark[e] - 1); }
};

/// Marks boundary, non-manifold, sharp and label edges one by one. featureAngle in radians.
FeatureEdges markFeatureEdges(const TriangleMesh& mesh, const TriangleEdges& edges, double featureAngle);

/// Lengths that chains are judged by, in units of the model.
struct ChainLimits {
  double weakAngle = 0.0;    ///< Dihedral angle in radians from which an edge may continue a sharp chain.
  double shortLength = 0.0;  ///< Sharp chains with a loose end that are shorter are dropped.
};

/// Continues sharp chains that end inside a face along weaker edges where that leads to another edge, then drops the
/// short chains that still end inside a face.
void cleanFeatureChains(const TriangleMesh& mesh, const TriangleEdges& edges, const ChainLimits& limits,
                        FeatureEdges& features);

}  // namespace qmcf::detail
