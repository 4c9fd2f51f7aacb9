#pragma once

#include <cstdint>

#include "qmcf/front/front_mesh.hpp"

namespace qmcf {

/// Removes free vertices of the open region by contracting edges, where the triangles around stay good.
void removeFreeVertices(FrontMesh& front);

/// Pairs triangles to quads, best pairs first; what is left are triangles. Returns the number of pairs.
std::int64_t pairTriangles(FrontMesh& front);

}  // namespace qmcf
