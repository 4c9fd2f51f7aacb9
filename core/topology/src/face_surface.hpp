#pragma once

#include <cstdint>

#include "qmcf/base/result.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf::detail {

/// What becomes brep.cuts[face]. Errors: internal, where the face's triangles are no surface or its loops not those of
/// the surface. \pre the faces' triangles and loops are complete
Result<FaceSurface> cutFace(const TriangleMesh& mesh, const Brep& brep, std::int32_t face);

}  // namespace qmcf::detail
