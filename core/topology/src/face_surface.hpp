#pragma once

#include <cstdint>

#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf::detail {

/// What becomes brep.cuts[face]. \pre the faces' triangles and loops are complete
FaceSurface cutFace(const TriangleMesh& mesh, const Brep& brep, std::int32_t face);

}  // namespace qmcf::detail
