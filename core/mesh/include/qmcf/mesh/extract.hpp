#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/mesh/edit_mesh.hpp"
#include "qmcf/mesh/face_mesh.hpp"

namespace qmcf {

/// The vertices and faces that are left, in the order of their ids; finished elements and open triangles alike.
/// patchVertex: per vertex of the mesh the boundary vertex of the patch; later vertices have none.
FaceMesh extract(const EditMesh& mesh, const std::vector<std::int32_t>& patchVertex);

}  // namespace qmcf
