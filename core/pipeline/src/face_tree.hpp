#pragma once

#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// A tree over the input triangles of one face.
TriangleBvh faceTree(const TriangleMesh& mesh, const BrepFace& face);

}  // namespace qmcf
