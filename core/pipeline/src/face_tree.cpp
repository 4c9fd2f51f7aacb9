#include "face_tree.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace qmcf {

TriangleBvh faceTree(const TriangleMesh& mesh, const BrepFace& face) {
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const std::int32_t t : face.triangles) triangles.push_back(mesh.triangles[static_cast<std::size_t>(t)]);
  return {mesh.positions, triangles};
}

}  // namespace qmcf
