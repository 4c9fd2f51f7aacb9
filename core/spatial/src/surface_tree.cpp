#include "qmcf/spatial/surface_tree.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace qmcf {

TriangleBvh surfaceTree(const Surface& surface) {
  std::vector<Vec3> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const VertexId v : surface.vertices()) positions.push_back(surface.position(v));
  for (const TriangleId t : surface.triangles()) {
    const auto corners = surface.corners(t);
    triangles.push_back({corners[0].value, corners[1].value, corners[2].value});
  }
  return {positions, triangles};
}

}  // namespace qmcf
