#include "qmcf/mesh/surface.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

Error brokenSurface(std::string what, std::int64_t element) {
  return {ErrorCode::malformedInput, std::move(what), {element}};
}

std::int64_t edgeKey(VertexId from, VertexId to, std::size_t vertexCount) {
  return static_cast<std::int64_t>(from.value) * static_cast<std::int64_t>(vertexCount) + to.value;
}

}  // namespace

Result<Surface> Surface::build(std::vector<Vec3> positions, const std::vector<std::array<std::int32_t, 3>>& triangles) {
  Surface s;
  s.position_.raw() = std::move(positions);
  const std::size_t vertexCount = s.vertexCount();
  s.outgoing_.resize(vertexCount);
  s.origin_.resize(3 * triangles.size());
  s.twin_.resize(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& corners = triangles[t];
    for (std::size_t c = 0; c < 3; ++c) {
      if (corners[c] < 0 || static_cast<std::size_t>(corners[c]) >= vertexCount) {
        return Error{ErrorCode::indexOutOfRange,
                     "Triangle " + std::to_string(t) + " names a vertex that does not exist.",
                     {static_cast<std::int64_t>(t)}};
      }
      if (corners[c] == corners[(c + 1) % 3]) {
        return brokenSurface("Triangle " + std::to_string(t) + " uses a vertex twice.", static_cast<std::int64_t>(t));
      }
      s.origin_[HalfedgeId(3 * t + c)] = VertexId(corners[c]);
    }
  }

  // Directed edges sorted by (from, to): a repeated one is non-manifold or inconsistently oriented, a reversed one is
  // the twin.
  std::vector<std::pair<std::int64_t, HalfedgeId>> directed;
  directed.reserve(s.halfedgeCount());
  for (const HalfedgeId h : s.halfedges()) directed.emplace_back(edgeKey(s.origin(h), s.target(h), vertexCount), h);
  std::sort(directed.begin(), directed.end());
  for (std::size_t i = 1; i < directed.size(); ++i) {
    if (directed[i].first == directed[i - 1].first) {
      const TriangleId t = triangle(directed[i].second);
      return brokenSurface(
          "Triangle " + std::to_string(t.value) + " runs along an edge in the same direction as another.", t.value);
    }
  }
  for (const auto& [key, h] : directed) {
    const std::int64_t reverse = edgeKey(s.target(h), s.origin(h), vertexCount);
    const auto it = std::lower_bound(directed.begin(), directed.end(), std::pair{reverse, HalfedgeId(0)});
    if (it != directed.end() && it->first == reverse) s.twin_[h] = it->second;
  }

  std::vector<std::int32_t> fanSize(vertexCount, 0);
  for (const HalfedgeId h : s.halfedges()) {
    const VertexId v = s.origin(h);
    ++fanSize[v.index()];
    if (!s.outgoing_[v].valid() || s.isBoundary(h)) s.outgoing_[v] = h;
  }
  for (const VertexId v : s.vertices()) {
    if (!s.outgoing_[v].valid())
      return brokenSurface("Vertex " + std::to_string(v.value) + " has no triangle.", v.value);
    std::int32_t visited = 0;
    s.forEachOutgoing(v, [&](HalfedgeId) { ++visited; });
    if (visited != fanSize[v.index()]) {
      return brokenSurface("Vertex " + std::to_string(v.value) + " joins several fans of triangles.", v.value);
    }
  }
  return s;
}

Vec3 Surface::areaVector(TriangleId t) const {
  const auto [a, b, c] = corners(t);
  return cross(position(b) - position(a), position(c) - position(a));
}

double Surface::angle(HalfedgeId h) const {
  const Vec3 p = position(origin(h));
  const Vec3 u = position(target(h)) - p;
  const Vec3 v = position(opposite(h)) - p;
  return math::atan2(norm(cross(u, v)), dot(u, v));
}

std::int64_t Surface::eulerCharacteristic() const {
  std::int64_t edges = 0;
  for (const HalfedgeId h : halfedges()) {
    if (isBoundary(h) || h < twin(h)) ++edges;
  }
  return static_cast<std::int64_t>(vertexCount()) - edges + static_cast<std::int64_t>(triangleCount());
}

std::vector<HalfedgeId> Surface::boundaryLoops() const {
  std::vector<HalfedgeId> loops;
  std::vector<bool> visited(halfedgeCount(), false);
  for (const HalfedgeId first : halfedges()) {
    if (!isBoundary(first) || visited[first.index()]) continue;
    loops.push_back(first);
    for (HalfedgeId h = first; !visited[h.index()]; h = nextBoundary(h)) visited[h.index()] = true;
  }
  return loops;
}

Vec3 positionOf(const Surface& surface, const SurfacePoint& point) {
  const auto [a, b, c] = surface.corners(point.triangle);
  return surface.position(a) * point.barycentric[0] + surface.position(b) * point.barycentric[1] +
         surface.position(c) * point.barycentric[2];
}

}  // namespace qmcf
