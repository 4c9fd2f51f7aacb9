#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/mesh/ids.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"

namespace qmcf::detail {

/// A closed chain of cutting edges without a corner or a junction: an edge of the B-rep that begins wherever it is
/// told.
struct Ring {
  std::vector<VertexId> points;     ///< In order; the first is that which comes first in the mesh.
  std::vector<std::int32_t> faces;  ///< Beside it, one for each side: twice the same where both sides are.
};

/// Where each ring begins: in a face between two rings and nothing else one begins across from the other, so that rims
/// with as many divisions have their nodes across from each other; starts pass on from face to face. Where none comes
/// to, a ring begins at its first point. hasVertices: per face, 1 where a vertex of the B-rep is on its boundary.
/// Complexity O(points).
std::vector<VertexId> placeRingStarts(const TriangleMesh& mesh, const std::vector<Ring>& rings,
                                      const std::vector<std::uint8_t>& hasVertices);

}  // namespace qmcf::detail
