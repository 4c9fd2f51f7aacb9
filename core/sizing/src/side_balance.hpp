#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// Divisions of one edge of the B-rep on their way to whole numbers.
struct EdgeCount {
  double wanted = 1.0;  ///< By the sizes, > 0.
  std::int32_t least = 1;
  std::int32_t count = 1;
  bool fixed = false;
};

/// Changes the counts such that opposite sides of faces match as far as the sizes allow.
///
/// A face without singularities has loops that close in the integer grid: with directions counted in quarter turns from
/// corner to corner, divisions of opposite directions are equal in sum. Each unit that they differ by costs a vertex
/// with three elements and one with five. The sum of these costs and of the edges' departures from what the sizes ask
/// for is lowered along closed walks over the faces: each face on the walk has two edges changed by one, so that the
/// numbers of divisions around the faces stay as even as they were. Bounded by a budget of steps; deterministic.
void balanceSides(const TriangleMesh& mesh, const Brep& brep, std::vector<EdgeCount>& edges);

}  // namespace qmcf
