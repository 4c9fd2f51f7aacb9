#pragma once

#include <cstdint>
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

/// Where subdivide() puts the new vertices inside.
enum class NewVertices : std::uint8_t {
  onFace,  ///< On the face below the middles of edges and elements.
  between  ///< Exactly in these middles: what a well shaped element is cut into is well shaped, whatever the face.
};

/// Cuts each quadrilateral in four and each triangle in three quadrilaterals. boundaryMiddle: where the new vertices on
/// the boundary lie, per half-edge of the patch (only boundary half-edges are read).
SubdividedFace subdivide(const FaceMesh& mesh, const Patch& patch, const TriangleBvh& target,
                         const IdMap<HalfedgeId, Vec3>& boundaryMiddle, NewVertices place = NewVertices::onFace);

}  // namespace qmcf
