#pragma once

#include "qmcf/mesh/surface.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"

namespace qmcf {

/// A tree over all triangles of a surface; its triangle ids are the surface's.
TriangleBvh surfaceTree(const Surface& surface);

}  // namespace qmcf
