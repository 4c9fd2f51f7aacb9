#pragma once

#include <optional>
#include <vector>

#include "qmcf/mesh/edit_mesh.hpp"

namespace qmcf {

bool containsFace(const std::vector<FaceId>& faces, FaceId f);

/// The boundary of a set of faces as one loop without repeated vertices, or nothing.
std::optional<std::vector<HalfedgeId>> boundaryLoop(const EditMesh& mesh, const std::vector<FaceId>& faces);

/// The vertices of the faces, ascending.
std::vector<VertexId> cornersOf(const EditMesh& mesh, const std::vector<FaceId>& faces);

/// What a vertex adds to the irregularity energy. A boundary vertex with too few elements has a straight or reflex
/// corner in one of them, which no relaxation can mend.
int irregularity(bool boundary, int excess);

bool allQuads(const EditMesh& mesh, const std::vector<FaceId>& faces);

/// The smallest faceShape() of the faces.
double worstOf(const EditMesh& mesh, const std::vector<FaceId>& faces);

}  // namespace qmcf
