#pragma once

#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// An edge of the B-rep as a curve over its arc length.
struct EdgeCurve {
  std::vector<Vec3> points;
  std::vector<double> arcLength;  ///< Per point, ascending from 0.
  bool closed = false;

  [[nodiscard]] double length() const { return arcLength.back(); }
  /// The point at arc length s, clamped to the edge.
  [[nodiscard]] Vec3 at(double s) const;
};

/// \pre edge.points has at least two entries.
EdgeCurve edgeCurve(const TriangleMesh& mesh, const BrepEdge& edge);

/// Linear interpolation in a table; clamped at its ends. \pre x ascending, not empty, as long as y.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at);

}  // namespace qmcf
