#include "qmcf/topology/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "qmcf/base/bounding_box.hpp"
#include "triangle_edges.hpp"
#include "weld.hpp"

namespace qmcf {
namespace detail {
namespace {

/// Sets of things that belong together (union-find).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count), used_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  void join(std::int32_t a, std::int32_t b) {
    used_[static_cast<std::size_t>(a)] = used_[static_cast<std::size_t>(b)] = 1;
    const std::int32_t ra = root(a);
    const std::int32_t rb = root(b);
    parent_[static_cast<std::size_t>(std::max(ra, rb))] = std::min(ra, rb);
  }
  [[nodiscard]] bool isRoot(std::int32_t v) const { return parent_[static_cast<std::size_t>(v)] == v; }
  /// Sets with a member that was joined to any.
  [[nodiscard]] std::int64_t count() const {
    std::int64_t roots = 0;
    for (std::size_t v = 0; v < parent_.size(); ++v) {
      if (used_[v] != 0 && parent_[v] == static_cast<std::int32_t>(v)) ++roots;
    }
    return roots;
  }

 private:
  std::int32_t root(std::int32_t v) {
    while (parent_[static_cast<std::size_t>(v)] != v) {
      auto& p = parent_[static_cast<std::size_t>(v)];
      p = parent_[static_cast<std::size_t>(p)];
      v = p;
    }
    return v;
  }
  std::vector<std::int32_t> parent_;
  std::vector<std::uint8_t> used_;
};

bool hasRepeatedCorner(const std::array<std::int32_t, 3>& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; }

void countShapes(const TriangleMesh& mesh, const Triangles& triangles, MeshStatistics& statistics) {
  const double smallArea = 1e-14 * statistics.diagonal * statistics.diagonal;
  for (const auto& c : triangles) {
    const auto at = [&](std::size_t i) -> const Vec3& { return mesh.positions[static_cast<std::size_t>(c[i])]; };
    const double twiceArea = norm(cross(at(1) - at(0), at(2) - at(0)));
    const double longest = std::fmax(std::fmax(distance(at(0), at(1)), distance(at(1), at(2))), distance(at(2), at(0)));
    if (hasRepeatedCorner(c) || 0.5 * twiceArea <= smallArea) ++statistics.degenerateTriangles;
    if (longest > 0.0 && twiceArea < 0.01 * longest * longest) ++statistics.sliverTriangles;
  }
}

void countDuplicates(Triangles triangles, MeshStatistics& statistics) {
  for (auto& c : triangles) std::sort(c.begin(), c.end());
  std::sort(triangles.begin(), triangles.end());
  for (std::size_t t = 1; t < triangles.size(); ++t) {
    if (triangles[t] == triangles[t - 1]) ++statistics.duplicateTriangles;
  }
}

/// \pre no triangle has a repeated corner.
void countTopology(const Triangles& triangles, std::size_t vertexCount, MeshStatistics& statistics) {
  const TriangleEdges edges(triangles, vertexCount);
  DisjointSets components(vertexCount);
  DisjointSets loops(vertexCount);
  for (const EdgeId e : edges.edges()) {
    const auto [a, b] = edges.ends(e);
    const std::size_t uses = edges.uses(e).size();
    components.join(a.value, b.value);
    if (uses == 1) {
      ++statistics.boundaryEdges;
      loops.join(a.value, b.value);
    } else if (uses == 2) {
      statistics.misorientedEdges += edges.isManifold(e) ? 0 : 1;
    } else {
      ++statistics.nonManifoldEdges;
    }
  }
  statistics.components = components.count();
  statistics.boundaryLoops = loops.count();

  // Corners at an end of an edge are joined, whichever way the triangles run.
  DisjointSets fans(edges.halfedgeCount());
  for (const EdgeId e : edges.edges()) {
    const auto cornerAt = [&](HalfedgeId h, VertexId v) { return edges.origin(h) == v ? h : Surface::next(h); };
    const HalfedgeId g = edges.uses(e)[0];
    for (const HalfedgeId h : edges.uses(e)) {
      for (const VertexId v : edges.ends(e)) fans.join(cornerAt(g, v).value, cornerAt(h, v).value);
    }
  }
  std::vector<std::int32_t> fansAt(vertexCount, 0);
  for (const HalfedgeId h : edges.halfedges()) {
    if (fans.isRoot(h.value)) ++fansAt[edges.origin(h).index()];
  }
  for (std::size_t v = 0; v < vertexCount; ++v) {
    if (fansAt[v] > 1) ++statistics.nonManifoldVertices;
  }
  const std::int64_t used = static_cast<std::int64_t>(vertexCount) - std::count(fansAt.begin(), fansAt.end(), 0);
  statistics.eulerCharacteristic =
      used - static_cast<std::int64_t>(edges.edgeCount()) + static_cast<std::int64_t>(triangles.size());
}

}  // namespace
}  // namespace detail

MeshStatistics meshStatistics(const TriangleMesh& mesh) {
  MeshStatistics statistics;
  statistics.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  BoundingBox box;
  for (const auto& corners : mesh.triangles) {
    for (const std::int32_t v : corners) box.include(mesh.positions[static_cast<std::size_t>(v)]);
  }
  if (mesh.triangles.empty()) return statistics;
  statistics.diagonal = box.diagonal();

  const std::vector<std::int32_t> first = detail::firstAtSamePoint(mesh);
  statistics.vertices = static_cast<std::int64_t>(mesh.positions.size());
  statistics.unusedVertices = std::count(first.begin(), first.end(), kNone);
  std::int64_t duplicates = 0;
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (first[v] != kNone && first[v] != static_cast<std::int32_t>(v)) ++duplicates;
  }
  detail::Triangles triangles = mesh.triangles;
  if (detail::isTriangleList(mesh)) {
    for (auto& corners : triangles) {
      for (std::int32_t& v : corners) v = first[static_cast<std::size_t>(v)];
    }
    statistics.vertices -= duplicates;
  } else {
    statistics.duplicateVertices = duplicates;
  }
  detail::countShapes(mesh, triangles, statistics);
  detail::countDuplicates(triangles, statistics);
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), detail::hasRepeatedCorner), triangles.end());
  detail::countTopology(triangles, mesh.positions.size(), statistics);
  return statistics;
}

}  // namespace qmcf
