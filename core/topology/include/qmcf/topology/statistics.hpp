#pragma once

#include <cstdint>

#include "qmcf/mesh/triangle_mesh.hpp"

namespace qmcf {

/// The state of a mesh as it was read, before any repair: what `qmcf info` prints first.
struct MeshStatistics {
  std::int64_t vertices = 0;             ///< Of the file; of a list of triangles (STL) after an exact weld.
  std::int64_t unusedVertices = 0;       ///< Of these, without a triangle.
  std::int64_t triangles = 0;            ///< Of the file, degenerate ones included.
  double diagonal = 0.0;                 ///< Of the bounding box of the used vertices.
  std::int64_t degenerateTriangles = 0;  ///< A repeated corner, or an area below 1e-14 of the squared diagonal.
  std::int64_t sliverTriangles = 0;      ///< Lower than 1 % of their longest edge.
  std::int64_t duplicateVertices = 0;    ///< At exactly the place of another one; 0 for a list of triangles.
  std::int64_t duplicateTriangles = 0;   ///< On the same three vertices as an earlier one.

  // Of the triangles without a repeated corner:
  std::int64_t components = 0;           ///< Connected through shared vertices.
  std::int64_t boundaryEdges = 0;        ///< With one triangle.
  std::int64_t boundaryLoops = 0;        ///< Connected sets of boundary edges.
  std::int64_t eulerCharacteristic = 0;  ///< Used vertices - edges + triangles.
  std::int64_t nonManifoldEdges = 0;     ///< With more than two triangles.
  std::int64_t nonManifoldVertices = 0;  ///< Whose triangles form more than one edge-connected fan.
  std::int64_t misorientedEdges = 0;     ///< Whose two triangles run along them in the same direction.
};

/// Complexity O(n log n). \pre indices in range, coordinates finite (as after reading).
MeshStatistics meshStatistics(const TriangleMesh& mesh);

}  // namespace qmcf
