#include "settle_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "qmcf/base/math.hpp"
#include "qmcf/field/natural_size.hpp"
#include "qmcf/sizing/inner_sizes.hpp"

namespace qmcf {
namespace {

/// A change of the size by less than this is not noticed.
constexpr double kNoticed = 0.05;
/// How far the logarithm of a size on an edge goes for the lengths that the edge was divided into, either way.
constexpr double kMostForDivision = 0.3;

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

/// Gives the patch these sizes, as far as they are allowed.
void take(PreparedFaces& prepared, std::size_t face, IdMap<VertexId, double> sizes, const RunOptions& options) {
  Patch& patch = prepared.patches[face];
  lowerToLimits(patch, prepared.size, sizes);
  const bool asksInside = options.curvature || !options.sizes.empty();
  for (const VertexId v : patch.surface.vertices()) {
    const double size = asksInside ? std::min(sizes[v], patch.size[v]) : sizes[v];
    if (std::fabs(size / patch.size[v] - 1.0) > kNoticed) prepared.settled[face] = 1;
    patch.size[v] = size;
  }
}

/// The sizes, with those on the boundary as its edges came out when they were divided.
IdMap<VertexId, double> dividedSizes(const Patch& patch) {
  const Surface& surface = patch.surface;
  IdMap<VertexId, double> log(surface.vertexCount(), 0.0);
  for (const HalfedgeId h : IdRange<HalfedgeId>(surface.halfedgeCount())) {
    if (!surface.isBoundary(h)) continue;
    const VertexId a = surface.origin(h);
    const VertexId b = surface.target(h);
    const double off = math::log(2.0 * surface.length(h) / (patch.size[a] + patch.size[b]));
    // The mean of both edges at a vertex.
    for (const VertexId end : {a, b}) log[end] += 0.5 * off;
  }
  IdMap<VertexId, double> sizes = patch.size;
  for (const VertexId v : surface.vertices()) {
    if (surface.isBoundary(v)) sizes[v] *= math::exp(math::bent(log[v], kMostForDivision));
  }
  return sizes;
}

}  // namespace

std::optional<Error> spreadInside(PreparedFaces& prepared, std::size_t face, const RunOptions& options,
                                  Progress& progress) {
  prepared.wantedElements[face] = expectedElements(prepared.patches[face]);
  prepared.settled[face] = 0;
  if (prepared.given[face] != Given::nothing) return std::nullopt;
  take(prepared, face, dividedSizes(prepared.patches[face]), options);
  auto sizes = spreadSizes(prepared.patches[face], progress);
  if (!sizes) return sizes.error();
  take(prepared, face, std::move(sizes).value(), options);
  return std::nullopt;
}

std::optional<Error> turnInside(PreparedFaces& prepared, std::size_t face, const RunOptions& options,
                                Progress& progress) {
  if (prepared.given[face] != Given::nothing) return std::nullopt;
  auto sizes = turnedSizes(prepared.patches[face], prepared.fields[face], progress);
  if (!sizes) return sizes.error();
  take(prepared, face, std::move(sizes).value(), options);
  return std::nullopt;
}

std::optional<Error> followMesh(PreparedFaces& prepared, std::size_t face, const FaceMesh& mesh,
                                const RunOptions& options, Progress& progress) {
  auto sizes = sizesOfMesh(prepared.patches[face], mesh, progress);
  if (!sizes) return sizes.error();
  take(prepared, face, std::move(sizes).value(), options);
  return std::nullopt;
}

double expectedElements(const Patch& patch) {
  const Surface& surface = patch.surface;
  double count = 0.0;
  for (const TriangleId t : surface.triangles()) {
    const auto corners = surface.corners(t);
    count += countInTriangle({patch.size[corners[0]], patch.size[corners[1]], patch.size[corners[2]]},
                             0.5 * norm(surface.areaVector(t)));
  }
  double outline = 0.0;
  for (const VertexId v : surface.vertices()) outline += surface.isBoundary(v) ? 1.0 : 0.0;
  return std::max(count, fewestQuads(outline, static_cast<double>(surface.eulerCharacteristic())));
}

}  // namespace qmcf
