#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "qmcf/mesh/edit_mesh.hpp"

namespace qmcf {

/// A way from one triangle through quadrilaterals to another: the edges that are crossed, each in the face that is
/// left.
using TrianglePath = std::vector<HalfedgeId>;

/// The cheapest paths from a triangle to others, at most `most` and each to another one, the cheapest first. None costs
/// more than 25, where a quadrilateral counts 1 and one in which the path turns 2, or passes through a face twice.
std::vector<TrianglePath> pathsToTriangles(const EditMesh& mesh, FaceId from, std::size_t most);

/// The quadrilaterals that the path's faces become, with the vertices that there are: the triangle merges with the half
/// of the first quadrilateral on its side of a diagonal, the other half is a triangle again, and so on. Of the two
/// diagonals those are taken that give the best shapes together.
std::vector<std::array<VertexId, 4>> quadsAlong(const EditMesh& mesh, const TrianglePath& path);

}  // namespace qmcf
