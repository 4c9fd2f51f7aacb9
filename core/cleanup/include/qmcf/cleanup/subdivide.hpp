#pragma once

#include <vector>

#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"

namespace qmcf {

/// The mesh of a face with every element cut at the middles of its edges.
struct SubdividedFace {
  FaceMesh mesh;                         ///< Quadrilaterals only. The vertices of the coarser mesh come first.
  std::vector<HalfedgeId> boundaryEdge;  ///< Per vertex: the patch's boundary edge that it halves; invalid elsewhere.
};

/// Cuts each quadrilateral in four and each triangle in three quadrilaterals. New vertices inside lie on the face;
/// boundaryMiddle: where those on the boundary lie, per half-edge of the patch (only boundary half-edges are read).
SubdividedFace subdivide(const FaceMesh& mesh, const Patch& patch, const TriangleBvh& target,
                         const IdMap<HalfedgeId, Vec3>& boundaryMiddle);

}  // namespace qmcf
