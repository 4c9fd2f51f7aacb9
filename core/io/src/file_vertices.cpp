#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>

#include "qmcf/io/read.hpp"

namespace qmcf {

std::vector<std::int32_t> fileVertices(const ReadModel& model) {
  const std::vector<Vec3>& positions = model.mesh.positions;
  std::vector<std::int32_t> vertices(positions.size());
  std::iota(vertices.begin(), vertices.end(), 0);
  if (model.format != InputFormat::stlAscii && model.format != InputFormat::stlBinary) return vertices;
  const auto point = [&](std::int32_t v) {
    const Vec3& p = positions[static_cast<std::size_t>(v)];
    return std::tuple(p.x + 0.0, p.y + 0.0, p.z + 0.0);  // -0 becomes 0.
  };
  std::vector<std::int32_t> order = vertices;
  std::sort(order.begin(), order.end(),
            [&](std::int32_t a, std::int32_t b) { return std::tuple(point(a), a) < std::tuple(point(b), b); });
  // First the first one at the same point, then its number.
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (point(order[i]) != point(order[i - 1])) continue;
    vertices[static_cast<std::size_t>(order[i])] = vertices[static_cast<std::size_t>(order[i - 1])];
  }
  std::int32_t count = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const auto first = static_cast<std::size_t>(vertices[v]);
    vertices[v] = first == v ? count++ : vertices[first];
  }
  return vertices;
}

}  // namespace qmcf
