#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "qmcf/base/vec.hpp"

namespace qmcf {

/// Largest lengths inside the faces, linear in the triangles of the part; those too large for the sizes to be linear in
/// them are cut into smaller ones. Graded along the triangles' edges.
struct InnerSizes {
  std::vector<Vec3> positions;                         ///< The vertices of the mesh first.
  std::vector<double> value;                           ///< Per position, > 0; at most SizeField::base.
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< One face after the other.
  std::vector<std::size_t> firstOfFace;                ///< Per face of the B-rep its first triangle; then the end.

  /// Nothing asks for sizes inside faces.
  [[nodiscard]] bool empty() const { return value.empty(); }
};

/// The integral of 1 / h^2 over a triangle of the given area with the sizes h > 0 at its corners, linear between.
double countInTriangle(const std::array<double, 3>& size, double area);

/// The same over all triangles: about the number of quads of these sizes.
double countOf(const InnerSizes& sizes);

/// How many quadrilaterals a face has that has no vertex inside: 4 Q = 2 E_inside + B and V - E + Q = chi. A row of
/// them has as many as it is long, however narrow it is. outline: its boundary's divisions; euler: its Euler
/// characteristic.
inline double fewestQuads(double outline, double euler) { return 0.5 * outline - euler; }

}  // namespace qmcf
