#include "constraints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "frames.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/topology/brep.hpp"
#include "singularities.hpp"

namespace qmcf {
namespace {

constexpr double kDenseBoundary = 6.0;                     // boundary length / sqrt(area)
constexpr double kLargestTurn = 17.5 * math::kPi / 180.0;  // of a cross along an edge between pinned vertices
constexpr std::uint8_t kEdgePin = 1;
constexpr std::uint8_t kCurvaturePin = 2;
constexpr std::uint8_t kStrokePin = 3;
constexpr double kStrokeWidth = 0.5;       // elements to either side
constexpr double kLeastTangentPart = 0.7;  // of a stroke's direction in the tangent plane

bool wanted(const Patch& patch, HalfedgeId h, const std::vector<std::uint8_t>& edgeKinds, const FieldOptions& options) {
  const std::int32_t edge = patch.edge.empty() ? kNone : patch.edge[h];
  if (edge < 0 || static_cast<std::size_t>(edge) >= edgeKinds.size()) return options.boundary;
  switch (static_cast<EdgeKind>(edgeKinds[static_cast<std::size_t>(edge)])) {
    case EdgeKind::nonManifold:
      return options.nonManifold;
    case EdgeKind::boundary:
      return options.boundary;
    case EdgeKind::sharp:
    case EdgeKind::label:
      return options.sharp;
  }
  return options.boundary;
}

}  // namespace

void pinBoundary(const Patch& patch, const std::vector<std::uint8_t>& edgeKinds, const FieldOptions& options,
                 FieldConditions& conditions) {
  const Surface& surface = patch.surface;
  for (const HalfedgeId h : surface.halfedges()) {
    if (!surface.isBoundary(h) || !wanted(patch, h, edgeKinds, options)) continue;
    for (const VertexId v : {surface.origin(h), surface.target(h)}) {
      conditions.pinned[v.index()] = kEdgePin;
      conditions.value[v.value] = 1.0;
    }
  }
}

void pinStrokes(const Patch& patch, const IdMap<VertexId, TangentFrame>& frames,
                const std::vector<FieldStroke>& strokes, FieldConditions& conditions) {
  const Surface& surface = patch.surface;
  const auto count = surface.vertexCount();
  std::vector<double> nearest(count, std::numeric_limits<double>::infinity());  // in elements
  for (const FieldStroke& stroke : strokes) {
    const Vec3 along = stroke.to - stroke.from;
    if (!(squaredNorm(along) > 0.0)) continue;
    const auto distanceInElements = [&](VertexId v) {
      const double f = dot(surface.position(v) - stroke.from, along) / squaredNorm(along);
      return distance(surface.position(v), stroke.from + along * std::clamp(f, 0.0, 1.0)) / patch.size[v];
    };
    VertexId closest;
    double least = 1.0;
    for (const VertexId v : surface.vertices()) {
      const double d = distanceInElements(v);
      if (d < least) {
        least = d;
        closest = v;
      }
    }
    for (const VertexId v : surface.vertices()) {
      const double d = distanceInElements(v);
      const bool tangential = norm(tangentPart(normalized(along), frames[v].normal)) > kLeastTangentPart;
      const bool reached = d < kStrokeWidth || v == closest;
      if (!reached || !tangential || d >= nearest[v.index()] || conditions.pinned[v.index()] == kEdgePin) continue;
      nearest[v.index()] = d;
      conditions.pinned[v.index()] = kStrokePin;
      conditions.value[v.value] = crossAlong(frames[v], along);
    }
  }
}

bool curvatureMatters(const Patch& patch, const FieldMatrices& matrices) {
  double length = 0.0;
  for (const HalfedgeId h : patch.surface.halfedges()) {
    if (patch.surface.isBoundary(h)) length += patch.surface.length(h);
  }
  return length <= kDenseBoundary * std::sqrt(matrices.area.sum());
}

void pullToCurvature(const Patch& patch, const CurvatureField& curvature, const FieldOptions& options,
                     FieldConditions& conditions) {
  const Surface& surface = patch.surface;
  std::vector<std::uint8_t> masked = conditions.pinned;
  for (const HalfedgeId h : surface.halfedges()) {
    if (!options.mask) break;
    const std::size_t a = surface.origin(h).index();
    const std::size_t b = surface.target(h).index();
    if (conditions.pinned[a] != 0) masked[b] = 1;
    if (conditions.pinned[b] != 0) masked[a] = 1;
  }
  for (const VertexId v : surface.vertices()) {
    if (masked[v.index()] != 0) continue;
    conditions.guide[v.value] = curvature.directions(v.value);
    conditions.pull[v.value] = 4.0 * options.guidance * std::norm(curvature.deviator[v.value]);
  }
}

void pinCurvature(const Patch& patch, const CurvatureField& curvature, const FieldOptions& options,
                  FieldConditions& conditions) {
  for (const VertexId v : patch.surface.vertices()) {
    if (conditions.pinned[v.index()] != 0 || curvature.anisotropy(v.value) < options.pinAnisotropy ||
        curvature.largest(v.value) * patch.size[v] < options.pinTurn) {
      continue;
    }
    conditions.pinned[v.index()] = kCurvaturePin;
    conditions.value[v.value] = curvature.directions(v.value);
  }
}

std::int32_t removeInconsistentPins(const Patch& patch, const Connection& connection, FieldConditions& conditions) {
  const Surface& surface = patch.surface;
  IdMap<VertexId, Complex> cross(surface.vertexCount());
  for (const VertexId v : surface.vertices()) cross[v] = conditions.value[v.value];
  const IdMap<TriangleId, std::int32_t> index = triangleIndices(surface, connection, cross);
  std::vector<std::uint8_t> bad(surface.vertexCount(), 0);
  for (const TriangleId t : surface.triangles()) {
    const auto [a, b, c] = surface.corners(t);
    const bool allPinned =
        conditions.pinned[a.index()] != 0 && conditions.pinned[b.index()] != 0 && conditions.pinned[c.index()] != 0;
    if (!allPinned || index[t] == 0) continue;
    for (const VertexId v : {a, b, c}) bad[v.index()] = 1;
  }
  for (const HalfedgeId h : surface.halfedges()) {
    const std::size_t a = surface.origin(h).index();
    const std::size_t b = surface.target(h).index();
    if (conditions.pinned[a] == 0 || conditions.pinned[b] == 0) continue;
    if (std::fabs(crossTurn(surface, connection, cross, h)) > 4.0 * kLargestTurn) bad[a] = bad[b] = 1;
  }
  std::int32_t freed = 0;
  for (std::size_t v = 0; v < bad.size(); ++v) {
    if (bad[v] == 0 || conditions.pinned[v] != kCurvaturePin) continue;
    conditions.pinned[v] = 0;
    conditions.removed[v] = 1;
    conditions.value[static_cast<Eigen::Index>(v)] = 0.0;
    ++freed;
  }
  return freed;
}

}  // namespace qmcf
