#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/mesh/ids.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"

namespace qmcf::detail {

/// A closed chain of cutting edges without a corner or a junction: an edge of the B-rep that begins wherever it is told.
struct Ring {
  std::vector<VertexId> points;     ///< In order; the first is that which comes first in the mesh.
  std::vector<std::int32_t> faces;  ///< Beside it, one for each side: twice the same where both sides are.
};

/// Where each ring begins: across from where the other rim of the face beside it begins, so that rims with as many
/// divisions have their nodes across from each other. A ring beside a face without any other ring begins nearest to a
/// vertex of that face; from there on starts pass over faces between two rings and nothing else; rings that no start
/// comes to begin at their first point. verticesOf: per face, the vertices of the B-rep on its boundary.
/// Complexity O(points), and at most 10^6 for the vertices of each face.
std::vector<VertexId> placeRingStarts(const TriangleMesh& mesh, const std::vector<Ring>& rings,
                                      const std::vector<std::vector<VertexId>>& verticesOf);

}  // namespace qmcf::detail
