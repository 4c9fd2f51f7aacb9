#pragma once

#include <vector>

#include "morph_mesh.hpp"

namespace qmcf {

/// Local smoothing after a quad was formed (step 4d; Owen et al. 1999): moves the given nodes and those joined to them.
/// Nodes on the front move as in paving (Blacker and Stephenson 1991), others to the length-weighted mean of their
/// neighbours. Nodes on the patch's boundary stay; no element is turned over. Returns all nodes looked at.
std::vector<VertexId> smoothAround(MorphMesh& morph, const std::vector<VertexId>& nodes);

/// Moves the given nodes, and those joined to them, wherever that makes the worst element around a node better. Returns
/// whether all elements around the given nodes are at least as good as `least` then. Boundary nodes stay.
bool untangle(MorphMesh& morph, const std::vector<VertexId>& nodes, double least);

}  // namespace qmcf
