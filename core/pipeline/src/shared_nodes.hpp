#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/sizing/divide.hpp"

namespace qmcf {

/// The nodes on the edges of the B-rep that the faces' meshes share.
struct SharedNodes {
  std::vector<Vec3> positions;
  std::vector<EdgeDivision> edges;      ///< Per edge of the B-rep.
  std::vector<std::int32_t> firstHalf;  ///< Per edge: the node that halves its first division, the others following;
                                        ///< empty where divisions are not halved.
};

/// The nodes of the divided edges.
SharedNodes sharedNodes(const DividedEdges& divided);

/// The same with one more node in the middle of each division.
SharedNodes halvedNodes(const TriangleMesh& mesh, const Brep& brep, const DividedEdges& divided);

/// The node that halves the division under a boundary half-edge of a patch. \pre shared comes from
/// halvedNodes(divided).
std::int32_t halvingNode(const Patch& patch, HalfedgeId h, const DividedEdges& divided, const SharedNodes& shared);

}  // namespace qmcf
