#pragma once

#include <vector>

#include "qmcf/front/front_mesh.hpp"

namespace qmcf {

/// Where a straight walk through open triangles ends.
struct WalkResult {
  enum class End : std::uint8_t {
    inside,   ///< In an open triangle: face.
    blocked,  ///< At a front edge: edge, and fraction of the way at which it is met.
    lost,     ///< The direction does not lie in the sector, or the walk ran into a degenerate triangle.
  };
  End end = End::lost;
  FaceId face;
  HalfedgeId edge;
  double fraction = 0.0;
};

/// Walks from the origin of the front edge `sector` straight towards target through open triangles.
WalkResult walkTowards(const FrontMesh& front, HalfedgeId sector, const Vec3& target, const LocalPlane& plane);

/// Makes a straight edge from the origin of `sector` to `target` by swaps of open triangles' edges (Owen et al. 1999,
/// top edge recovery), within that sector. Returns the half-edge, or an invalid one; the mesh may then have been
/// changed.
HalfedgeId recoverEdge(FrontMesh& front, HalfedgeId sector, VertexId target);

/// Puts a vertex at the end of a walk from the origin of `sector`: by moving a free vertex that is near (within
/// `reuse`), else by splitting the open edge or triangle found there. Returns an invalid id where a front is in the
/// way.
VertexId insertVertex(FrontMesh& front, HalfedgeId sector, const EditMesh::Vertex& vertex, double reuse);

/// Splits or reuses in a given open face.
VertexId insertInFace(FrontMesh& front, FaceId face, const EditMesh::Vertex& vertex, double reuse);

/// Whether the edge of two open triangles can be swapped: strictly convex, no double edge.
bool canSwap(const FrontMesh& front, HalfedgeId h);

/// Swaps edges of open triangles around the vertices until they are locally Delaunay; bounded.
void makeDelaunay(FrontMesh& front, const std::vector<VertexId>& around);

}  // namespace qmcf
