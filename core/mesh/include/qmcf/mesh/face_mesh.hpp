#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/mesh/quad_mesh.hpp"
#include "qmcf/mesh/surface.hpp"

namespace qmcf {

/// The quad-dominant mesh of one face of the B-rep, before the faces are joined at their shared nodes.
struct FaceMesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;              ///< Unit normals of the underlying surface.
  std::vector<SurfacePoint> locations;    ///< On the patch's surface.
  std::vector<std::int32_t> patchVertex;  ///< Boundary vertex of the patch, which is fixed; kNone inside.
  std::vector<Element> elements;
};

/// The triangles of a patch as a mesh of it.
FaceMesh trianglesOf(const Patch& patch);

/// Each edge of the mesh once: its ends, the lower one first, in ascending order.
std::vector<std::array<std::int32_t, 2>> edgesOf(const FaceMesh& mesh);

}  // namespace qmcf
