#include "qmcf/sizing/size_scale.hpp"

#include <cmath>
#include <cstddef>

#include "qmcf/sizing/inner_sizes.hpp"

namespace qmcf {

SizeScale::SizeScale(std::vector<Face> faces) {
  double area = 0.0;
  double count = 0.0;
  double length = 0.0;
  double sides = 0.0;
  for (const Face& face : faces) {
    Factors& factors = faces_.emplace_back();
    factors.tree = TriangleBvh(face.positions, face.triangles);
    for (const auto& t : face.triangles) {
      const auto at = [&](std::size_t c) -> const Vec3& { return face.positions[static_cast<std::size_t>(t[c % 3])]; };
      const auto of = [&](std::size_t c) { return face.factor[static_cast<std::size_t>(t[c])]; };
      factors.corner.push_back({of(0), of(1), of(2)});
      const double own = 0.5 * norm(cross(at(1) - at(0), at(2) - at(0)));
      area += own;
      count += countInTriangle(factors.corner.back(), own);
      for (std::size_t c = 0; c < 3; ++c) length += distance(at(c), at(c + 1));
      sides += 3.0;
    }
  }
  if (count > 0.0) mean_ = std::sqrt(area / count);
  if (sides > 0.0) spacing_ = length / sides;
}

double SizeScale::at(std::int32_t face, const Vec3& p) const {
  const Factors& factors = faces_[static_cast<std::size_t>(face)];
  const ClosestPoint closest = factors.tree.closest(p);
  const auto& corner = factors.corner[static_cast<std::size_t>(closest.triangle)];
  double factor = 0.0;
  for (std::size_t c = 0; c < 3; ++c) factor += closest.barycentric[c] * corner[c];
  return factor;
}

}  // namespace qmcf
