#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "qmcf/mesh/edit_mesh.hpp"

namespace qmcf {

/// A way from one triangle through quadrilaterals to another, and the quadrilaterals that all these become with the
/// vertices that there are: the triangle merges with the half of the first quadrilateral on its side of a diagonal, the
/// other half is a triangle again, and so on.
struct TriangleWay {
  std::vector<HalfedgeId> crossed;             ///< The edges that are crossed, each in the face that is left.
  std::vector<std::array<VertexId, 4>> quads;  ///< One per edge: the triangle's apex, the edge with the far corner.
};

/// The ways from a triangle to others that give the best shapes together, as they are before anything moves: at most
/// `most` and each to another triangle, the best first. None costs more than `mostCost`, where a quadrilateral costs
/// the square of what its shape lacks and 0.02, and much more if it is poor; none passes through a face twice.
std::vector<TriangleWay> waysToTriangles(const EditMesh& mesh, FaceId from, std::size_t most, double mostCost);

/// Makes the quadrilaterals. Returns false, with a part of them made, if one would have a vertex twice or an edge that
/// is there already.
bool mergeAlong(EditMesh& mesh, const TriangleWay& way);

}  // namespace qmcf
