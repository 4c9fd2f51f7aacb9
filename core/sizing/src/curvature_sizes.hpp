#pragma once

#include <vector>

#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// Lengths whose chords keep within a distance of the curved faces; infinite where these are flat.
struct CurvatureSizes {
  std::vector<double> vertex;    ///< Per vertex of the mesh; on an edge of the B-rep the smallest of its faces.
  std::vector<double> triangle;  ///< Per triangle, by its own curvature alone.
};

/// The length of a chord of an arc whose middle is `chordError` away from it: 2 sqrt(2 E / k - E^2), but no more than
/// the diameter; infinite for k = 0. chordError: > 0; curvature: >= 0.
double chordLength(double curvature, double chordError);

/// By the larger principal curvature of each face (E1 of docs/algorithm.md). Complexity O(n).
CurvatureSizes curvatureSizes(const TriangleMesh& mesh, const Brep& brep, double chordError);

}  // namespace qmcf
