#pragma once

#include <array>

#include "qmcf/mesh/edit_mesh.hpp"
#include "qmcf/mesh/face_mesh.hpp"

namespace qmcf {

/// Scaled Jacobian of a quadrilateral: the smallest corner determinant, about the normal of its diagonals, over the
/// product of the two sides, in [-1, 1]. Less, down to -1.2, where a corner leans away from the surface normal there.
double quadShape(const EditMesh& mesh, const std::array<VertexId, 4>& corners);

/// Shape of a triangle along the mean normal: 2 sqrt(3) |AB x AC| / (sum of squared sides), 1 for the equilateral one,
/// negative when it is turned over.
double triangleShape(const EditMesh& mesh, VertexId a, VertexId b, VertexId c);

/// quadShape() or triangleShape() of a face.
double faceShape(const EditMesh& mesh, FaceId f);

/// Whether a corner of the face is turned over, against the face's own normal or the surface's.
bool isInverted(const EditMesh& mesh, FaceId f);
/// Whether an element is unusable whatever surface it lies on: a quad with a scaled Jacobian of 0 or less, a triangle
/// without area.
bool isDegenerate(const EditMesh& mesh, FaceId f);

/// The worst faceShape() around a vertex.
double worstShapeAround(const EditMesh& mesh, VertexId v);
/// The worst scaled Jacobian of the quadrilaterals around a vertex by their own normals, whatever the surface; at most
/// 0.3, from which on it doesn't matter.
double worstSquareAround(const EditMesh& mesh, VertexId v);
/// Whether worstShapeAround() is at least `least`, in (0, 1]; much faster where it is by far.
bool isWellShapedAround(const EditMesh& mesh, VertexId v, double least);

/// The smallest sine at the corners of an element, about the mean of the surface's normals there: 1 for a square, 0.87
/// for an equilateral triangle, negative where a corner is turned over; -1 where a side has no length.
/// fills: per corner, whether the element is alone in a corner of the outline. An acute one is not the element's fault
/// then, and left out; but a quadrilateral with a sine below 0.1 there counts as turned over, -1.
double elementShape(const FaceMesh& mesh, const Element& element, const std::array<bool, 4>& fills = {});

/// What an element of that shape costs in a face with little choice: (1 - shape)^4, 1 more below 0.4, 3 more below
/// 0.12, and 4 for a triangle.
double shapeCost(double shape, bool isTriangle);

/// The costs of all elements of a mesh together.
double shapeCost(const FaceMesh& mesh);

}  // namespace qmcf
