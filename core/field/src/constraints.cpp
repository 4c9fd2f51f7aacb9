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

constexpr double kLargestTurn = 17.5 * math::kPi / 180.0;  // of a cross along an edge between pinned vertices
constexpr double kStrokeWidth = 0.5;                       // elements to either side
constexpr double kLeastTangentPart = 0.7;                  // of a stroke's direction in the tangent plane

/// What a boundary half-edge pins its ends as.
FieldPin pinOf(const Patch& patch, HalfedgeId h, const std::vector<std::uint8_t>& edgeKinds) {
  const std::int32_t edge = patch.edge.empty() ? kNone : patch.edge[h];
  if (edge < 0 || static_cast<std::size_t>(edge) >= edgeKinds.size()) return FieldPin::boundary;
  switch (static_cast<EdgeKind>(edgeKinds[static_cast<std::size_t>(edge)])) {
    case EdgeKind::nonManifold:
      return FieldPin::nonManifold;
    case EdgeKind::sharp:
    case EdgeKind::label:
      return FieldPin::sharp;
    case EdgeKind::boundary:
      break;
  }
  return FieldPin::boundary;
}

bool wanted(FieldPin pin, const FieldOptions& options) {
  if (pin == FieldPin::nonManifold) return options.nonManifold;
  return pin == FieldPin::sharp ? options.sharp : options.boundary;
}

bool isEdgePin(FieldPin pin) {
  return pin == FieldPin::boundary || pin == FieldPin::sharp || pin == FieldPin::nonManifold;
}

}  // namespace

void pinBoundary(const Patch& patch, const std::vector<std::uint8_t>& edgeKinds, const FieldOptions& options,
                 FieldConditions& conditions) {
  const Surface& surface = patch.surface;
  for (const HalfedgeId h : surface.halfedges()) {
    if (!surface.isBoundary(h)) continue;
    const FieldPin pin = pinOf(patch, h, edgeKinds);
    if (!wanted(pin, options)) continue;
    for (const VertexId v : {surface.origin(h), surface.target(h)}) {
      conditions.pinned[v.index()] = std::max(conditions.pinned[v.index()], pin);
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
      if (!reached || !tangential || d >= nearest[v.index()] || isEdgePin(conditions.pinned[v.index()])) continue;
      nearest[v.index()] = d;
      conditions.pinned[v.index()] = FieldPin::user;
      conditions.value[v.value] = crossAlong(frames[v], along);
    }
  }
}

double boundaryDensity(const Patch& patch, const FieldMatrices& matrices) {
  double length = 0.0;
  for (const HalfedgeId h : patch.surface.halfedges()) {
    if (patch.surface.isBoundary(h)) length += patch.surface.length(h);
  }
  return length / std::sqrt(matrices.area.sum());
}

void pullToCurvature(const Patch& patch, const CurvatureField& curvature, const FieldOptions& options,
                     FieldConditions& conditions) {
  const Surface& surface = patch.surface;
  conditions.pull.setZero();
  IdMap<VertexId, std::uint8_t> masked(surface.vertexCount(), 0);
  for (const HalfedgeId h : surface.halfedges()) {
    const VertexId a = surface.origin(h);
    const VertexId b = surface.target(h);
    if (options.mask && (conditions.isPinned(a) || conditions.isPinned(b))) masked[a] = masked[b] = 1;
  }
  for (const VertexId v : surface.vertices()) {
    if (masked[v] != 0) continue;
    conditions.guide[v.value] = curvature.directions(v.value);
    conditions.pull[v.value] = 4.0 * options.guidance * std::norm(curvature.deviator[v.value]);
  }
}

void pinCurvature(const Patch& patch, const CurvatureField& curvature, const FieldOptions& options,
                  FieldConditions& conditions) {
  for (const VertexId v : patch.surface.vertices()) {
    if (conditions.isPinned(v) || curvature.anisotropy(v.value) < options.pinAnisotropy ||
        curvature.largest(v.value) * patch.size[v] < options.pinTurn) {
      continue;
    }
    conditions.pinned[v.index()] = FieldPin::curvature;
    conditions.value[v.value] = curvature.directions(v.value);
  }
}

std::int32_t removeInconsistentPins(const Patch& patch, const Connection& connection, const FieldVector& crosses,
                                    const std::vector<std::uint8_t>& known, FieldConditions& conditions) {
  const Surface& surface = patch.surface;
  IdMap<VertexId, Complex> cross(surface.vertexCount());
  for (const VertexId v : surface.vertices()) cross[v] = crosses[v.value];
  const IdMap<TriangleId, std::int32_t> index = triangleIndices(surface, connection, cross);
  std::vector<std::uint8_t> bad(surface.vertexCount(), 0);
  for (const TriangleId t : surface.triangles()) {
    const auto [a, b, c] = surface.corners(t);
    if (index[t] == 0 || known[a.index()] == 0 || known[b.index()] == 0 || known[c.index()] == 0) continue;
    for (const VertexId v : {a, b, c}) bad[v.index()] = 1;
  }
  for (const HalfedgeId h : surface.halfedges()) {
    const std::size_t a = surface.origin(h).index();
    const std::size_t b = surface.target(h).index();
    if (known[a] == 0 || known[b] == 0) continue;
    if (std::fabs(crossTurn(surface, connection, cross, h)) > 4.0 * kLargestTurn) bad[a] = bad[b] = 1;
  }
  std::int32_t freed = 0;
  for (std::size_t v = 0; v < bad.size(); ++v) {
    if (bad[v] == 0 || conditions.pinned[v] != FieldPin::curvature) continue;
    conditions.pinned[v] = FieldPin::none;
    conditions.removed[v] = 1;
    conditions.value[static_cast<Eigen::Index>(v)] = 0.0;
    ++freed;
  }
  return freed;
}

}  // namespace qmcf
