#include "face_sizes.hpp"

#include <algorithm>
#include <cstddef>

namespace qmcf {

FaceSizes::FaceSizes(const SizeField& field, std::int32_t face) {
  const InnerSizes& inner = field.inner;
  if (inner.empty()) return;
  std::vector<Vec3> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
  bool asks = false;
  for (std::size_t t = inner.firstOfFace[static_cast<std::size_t>(face)];
       t < inner.firstOfFace[static_cast<std::size_t>(face) + 1]; ++t) {
    const auto first = static_cast<std::int32_t>(positions.size());
    triangles.push_back({first, first + 1, first + 2});
    std::array<double, 3>& size = size_.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      const auto v = static_cast<std::size_t>(inner.triangles[t][c]);
      positions.push_back(inner.positions[v]);
      size[c] = inner.value[v];
      asks = asks || size[c] < field.base;
    }
  }
  if (asks) tree_ = TriangleBvh(positions, triangles);
}

FaceSizes::Found FaceSizes::at(const Vec3& p, std::int32_t hint) const {
  const ClosestPoint closest = tree_.closest(p, hint);
  Found found{0.0, closest.triangle};
  for (std::size_t c = 0; c < 3; ++c) {
    found.size += closest.barycentric[c] * size_[static_cast<std::size_t>(closest.triangle)][c];
  }
  return found;
}

}  // namespace qmcf
