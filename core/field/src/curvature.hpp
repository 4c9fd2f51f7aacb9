#pragma once

#include "matrices.hpp"

namespace qmcf {

/// The shape operator at every vertex, positive for a convex surface.
struct CurvatureField {
  FieldVector deviator;  ///< In the vertex's angles, |deviator| e^(2 i a): a points along the larger principal
                         ///< curvature and |deviator| is half the difference of the two.
  Eigen::VectorXd mean;  ///< Half the sum of the principal curvatures.

  /// |k1 - k2| / (|k1| + |k2|) in [0, 1]: 1 on a cylinder, 0 on a sphere or a plane.
  [[nodiscard]] double anisotropy(Eigen::Index v) const;
  /// The larger of |k1| and |k2|.
  [[nodiscard]] double largest(Eigen::Index v) const;
  /// The cross along the principal directions; 0 where there are none.
  [[nodiscard]] Complex directions(Eigen::Index v) const;
};

/// Curvature from how the patch's normals change over each triangle (Rusinkiewicz 2004; B4 of docs/algorithm.md),
/// averaged over the triangles around each vertex, `rounds` times.
CurvatureField estimateCurvature(const Patch& patch, const Connection& connection, int rounds = 2);

}  // namespace qmcf
