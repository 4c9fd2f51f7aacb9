#pragma once

#include <complex>

#include "qmcf/mesh/ids.hpp"
#include "qmcf/mesh/surface.hpp"

namespace qmcf {

/// How the normal of a smooth surface turns along its tangents, positive for a convex surface. In units of 1 / length.
struct ShapeOperator {
  std::complex<double> deviator;  ///< |deviator| e^(2 i a): a is the angle of the larger principal curvature's
                                  ///< direction and |deviator| is half the difference of the two.
  double mean = 0.0;              ///< Half the sum of the principal curvatures.
};

/// The symmetric matrix (e f; f g) that maps the triangle's edges to the changes of the vertices' unit normals along
/// them, by least squares over the three edges (Rusinkiewicz 2004). Angles count from the triangle's first edge. Zero
/// in a degenerate triangle.
ShapeOperator triangleShape(const Surface& surface, const IdMap<VertexId, Vec3>& normal, TriangleId t);

/// Unit normals at the vertices: the means of their triangles' normals, weighted by the angles there. Zero where these
/// cancel.
IdMap<VertexId, Vec3> angleWeightedNormals(const Surface& surface);

}  // namespace qmcf
