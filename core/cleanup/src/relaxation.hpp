#pragma once

#include <vector>

#include "qmcf/mesh/edit_mesh.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"

namespace qmcf {

/// Where vertices may move to.
struct RelaxationTarget {
  const Patch& patch;       ///< Sizes and normals.
  const TriangleBvh& face;  ///< The face's input triangles.
  double sizeScale = 1.0;   ///< Element length in units of the patch's sizes.
  bool onPatch = false;     ///< Project on the patch's triangles instead: near, and cheaper, for what is only tried.
};

/// The place on the face nearest to a position, with normal and location.
EditMesh::Vertex projectVertex(const RelaxationTarget& target, const EditMesh::Vertex& from, const Vec3& position);

/// Where the square (equilateral triangle) that fits the face of h best has its corner at origin(h), in the tangent
/// plane of normal; size: the edge length wanted there.
Vec3 idealCorner(const EditMesh& mesh, HalfedgeId h, const Vec3& normal, double size);

/// One Gauss-Seidel sweep over the given vertices: each moves to the mean of the places that the best-fitting squares
/// (equilateral triangles) of its elements give it, is projected, and stays where it was if an element around it would
/// become worse than both before and `enough`. Boundary vertices don't move. Returns the largest move relative to the
/// element size.
double relax(EditMesh& mesh, const std::vector<VertexId>& vertices, const RelaxationTarget& target, double enough);

}  // namespace qmcf
