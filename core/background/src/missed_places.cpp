#include "missed_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "qmcf/spatial/surface_tree.hpp"

namespace qmcf {
namespace {

constexpr double kSpacing = 0.25;  // Of the places looked at, in units of the base size.
constexpr double kDistance = 0.5;  // In units of the local size.
constexpr double kLowest = 0.3;
constexpr double kMinCosine = 0.3;

/// One vertex from each cube of a grid, those with the smallest ids, ascending.
std::vector<VertexId> spacedVertices(const Surface& surface, double width) {
  using Cell = std::array<std::int64_t, 3>;
  std::vector<std::pair<Cell, std::int32_t>> entries;
  const auto cell = [width](double x) { return static_cast<std::int64_t>(std::floor(x / width)); };
  for (const VertexId v : surface.vertices()) {
    if (surface.isBoundary(v)) continue;
    const Vec3& p = surface.position(v);
    entries.push_back({{cell(p.x), cell(p.y), cell(p.z)}, v.value});
  }
  std::sort(entries.begin(), entries.end());
  std::vector<VertexId> spaced;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i == 0 || entries[i].first != entries[i - 1].first) spaced.emplace_back(entries[i].second);
  }
  std::sort(spaced.begin(), spaced.end());
  return spaced;
}

}  // namespace

std::vector<SizeLimit> findMissedPlaces(const Surface& face, const FaceReference& reference, const Patch& patch,
                                        double base) {
  std::vector<SizeLimit> missed;
  if (reference.isPlanar()) return missed;
  const TriangleBvh tree = surfaceTree(patch.surface);
  for (const VertexId v : spacedVertices(face, kSpacing * base)) {
    const Vec3& p = face.position(v);
    const ClosestPoint near = tree.closest(p, reference.vertexNormal(v.value), kMinCosine);
    double size = 0.0;
    const auto corners = patch.surface.corners(TriangleId(near.triangle));
    for (std::size_t c = 0; c < 3; ++c) size += near.barycentric[c] * patch.size[corners[c]];
    const double wanted = std::max(0.5 * size, kLowest * base);
    const bool isFar = near.squaredDistance > kDistance * kDistance * size * size;
    if (isFar && wanted < 0.9 * size) missed.push_back({patch.face, p, wanted});
  }
  return missed;
}

}  // namespace qmcf
