#pragma once

#include "qmcf/front/front_mesh.hpp"
#include "qmcf/mesh/face_mesh.hpp"

namespace qmcf {

/// The working triangulation as a mesh of its own: finished elements and open triangles alike.
FaceMesh extract(const FrontMesh& front);

}  // namespace qmcf
