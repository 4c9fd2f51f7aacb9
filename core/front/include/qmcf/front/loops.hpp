#pragma once

#include <vector>

#include "qmcf/front/front_mesh.hpp"

namespace qmcf {

/// The front edges that leave a vertex or end there.
std::vector<HalfedgeId> frontEdgesAt(const FrontMesh& front, VertexId v);

/// Number of front loops with an odd number of edges among those that the given edges belong to; others than front
/// edges don't count. Only even loops can be filled with quads (C5). Complexity: the length of the loops.
int oddLoops(const FrontMesh& front, const std::vector<HalfedgeId>& edges);

}  // namespace qmcf
