#include "settle_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "qmcf/base/parallel.hpp"
#include "qmcf/field/natural_size.hpp"
#include "qmcf/sizing/inner_sizes.hpp"

namespace qmcf {
namespace {

/// A change of the size by less than this is not noticed.
constexpr double kNoticed = 0.05;

/// Lowers sizes to the cones that rise from the field's limits in the patch.
void lowerToLimits(const Patch& patch, const SizeField& field, IdMap<VertexId, double>& sizes) {
  for (const SizeLimit& limit : field.limits) {
    if (limit.face != patch.face) continue;
    for (const VertexId v : patch.surface.vertices()) {
      const double most = limit.size + field.gradation * distance(limit.position, patch.surface.position(v));
      sizes[v] = std::min(sizes[v], most);
    }
  }
}

}  // namespace

std::optional<Error> settleSizes(PreparedFaces& prepared, const std::vector<std::int32_t>& faces,
                                 const MeshOptions& options, Progress& progress) {
  const bool asksInside = options.curvature || !options.sizes.empty();
  prepared.wantedElements.resize(prepared.patches.size(), 0.0);
  prepared.settled.resize(prepared.patches.size(), 0);
  std::vector<double> costs;
  for (const std::int32_t face : faces) {
    costs.push_back(static_cast<double>(prepared.patches[static_cast<std::size_t>(face)].surface.triangleCount()));
  }
  const auto settle = [&](std::size_t i, Progress& own) -> std::optional<Error> {
    const auto f = static_cast<std::size_t>(faces[i]);
    Patch& patch = prepared.patches[f];
    prepared.wantedElements[f] = expectedElements(patch);
    prepared.settled[f] = 0;
    if (prepared.given[f] != Given::nothing) return std::nullopt;
    auto settled = settledSizes(patch, prepared.fields[f], own);
    if (!settled) return settled.error();
    IdMap<VertexId, double>& sizes = settled.value();
    lowerToLimits(patch, prepared.size, sizes);
    for (const VertexId v : patch.surface.vertices()) {
      const double size = asksInside ? std::min(sizes[v], patch.size[v]) : sizes[v];
      if (std::fabs(size / patch.size[v] - 1.0) > kNoticed) prepared.settled[f] = 1;
      patch.size[v] = size;
    }
    return std::nullopt;
  };
  return parallelFor(costs, threadsOf(options), progress, settle);
}

double expectedElements(const Patch& patch) {
  double count = 0.0;
  for (const TriangleId t : patch.surface.triangles()) {
    const auto corners = patch.surface.corners(t);
    count += countInTriangle({patch.size[corners[0]], patch.size[corners[1]], patch.size[corners[2]]},
                             0.5 * norm(patch.surface.areaVector(t)));
  }
  return count;
}

}  // namespace qmcf
