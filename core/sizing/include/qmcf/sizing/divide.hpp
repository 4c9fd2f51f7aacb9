#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/base/result.hpp"
#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/sizing/size_field.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// The nodes that the faces share along one edge of the B-rep.
struct EdgeDivision {
  std::vector<std::int32_t>
      nodes;  ///< Node ids from start to end; n divisions have n + 1 entries (closed: first == last).
  std::vector<double> arcLength;  ///< Per entry: arc length from the start of the edge, ascending.
};

/// Every edge of the B-rep cut into whole elements.
struct DividedEdges {
  std::vector<Vec3> nodes;          ///< Positions, on the edges; B-rep vertices come first, in their order.
  std::vector<double> nodeSize;     ///< Per node: target length.
  std::vector<EdgeDivision> edges;  ///< Per edge of the B-rep.
  std::int64_t oddFaces = 0;  ///< Faces with an odd number of boundary edges: they do better so, or can't be even.
};

/// Divides by the size field: round(integral of ds / h), at least 1 (at least 3 on a closed edge), with nodes at equal
/// parts of the integral; then solves parity over all faces, so that each has an even number of boundary edges wherever
/// that is possible, and makes opposite sides of faces match where the sizes allow it (E4 and E5 of docs/algorithm.md).
/// minimumDivisions: per edge, a lower bound, or empty. asGiven: per edge, 1 where the nodes shall be the edge's own
/// points and no others, or empty. quadsOnly: also faces that do better with a triangle get an even number.
DividedEdges divideEdges(const TriangleMesh& mesh, const Brep& brep, const SizeField& size,
                         const std::vector<std::int32_t>& minimumDivisions = {},
                         const std::vector<std::uint8_t>& asGiven = {}, bool quadsOnly = false);

}  // namespace qmcf
