#pragma once

#include <array>

#include "qmcf/mesh/edit_mesh.hpp"

namespace qmcf {

/// Scaled Jacobian of a quadrilateral as seen along the surface normals at its corners: the smallest corner determinant
/// over the product of its side lengths, in [-1, 1]. Negative when a corner is turned over or reflex.
double quadShape(const EditMesh& mesh, const std::array<VertexId, 4>& corners);

/// Shape of a triangle along the mean normal: 2 sqrt(3) |AB x AC| / (sum of squared sides), 1 for the equilateral one,
/// negative when it is turned over.
double triangleShape(const EditMesh& mesh, VertexId a, VertexId b, VertexId c);

/// quadShape() or triangleShape() of a face.
double faceShape(const EditMesh& mesh, FaceId f);

/// The worst faceShape() around a vertex.
double worstShapeAround(const EditMesh& mesh, VertexId v);

}  // namespace qmcf
