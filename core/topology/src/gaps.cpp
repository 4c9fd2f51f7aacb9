// Gaps between pieces that were meant to join: boundary vertices at almost the same place are merged, and where a
// boundary vertex lies on another boundary edge (a T-junction) that edge is split there. Only boundaries are touched,
// so a closed surface stays as it is however small its details are.

#include <algorithm>
#include <array>
#include <numeric>

#include "edit_soup.hpp"
#include "point_grid.hpp"
#include "repair_state.hpp"
#include "triangle_edges.hpp"

namespace qmcf::detail {
namespace {

struct Boundary {
  std::vector<std::array<std::int32_t, 2>> edges;
  std::vector<std::int32_t> vertices;  ///< Ascending.
};

Boundary findBoundary(const TriangleMesh& mesh) {
  Boundary boundary;
  const TriangleEdges edges(mesh.triangles, mesh.positions.size());
  for (const EdgeId e : edges.edges()) {
    if (edges.uses(e).size() != 1) continue;
    const auto [a, b] = edges.ends(e);
    boundary.edges.push_back({a.value, b.value});
    boundary.vertices.insert(boundary.vertices.end(), {a.value, b.value});
  }
  std::sort(boundary.vertices.begin(), boundary.vertices.end());
  boundary.vertices.erase(std::unique(boundary.vertices.begin(), boundary.vertices.end()), boundary.vertices.end());
  return boundary;
}

struct ClosePair {
  double distance;
  std::int32_t kept;
  std::int32_t gone;
  friend bool operator<(const ClosePair& a, const ClosePair& b) {
    if (a.distance != b.distance) return a.distance < b.distance;
    return a.kept != b.kept ? a.kept < b.kept : a.gone < b.gone;
  }
};

/// Merges boundary vertices within the tolerance, closest pairs first. Returns how many went.
std::int64_t weldBoundary(RepairState& state, const Boundary& boundary, RepairItem& item) {
  const TriangleMesh& mesh = state.mesh;
  const PointGrid grid(mesh.positions, boundary.vertices, state.tolerance);
  const auto at = [&](std::int32_t v) -> const Vec3& { return mesh.positions[static_cast<std::size_t>(v)]; };
  std::vector<ClosePair> pairs;
  for (const std::int32_t v : boundary.vertices) {
    grid.forEachNear(at(v), [&](std::int32_t w) {
      if (w <= v) return;
      const double apart = distance(at(v), at(w));
      if (apart <= state.tolerance) pairs.push_back({apart, v, w});
    });
  }
  if (pairs.empty()) return 0;
  std::sort(pairs.begin(), pairs.end());

  std::vector<std::int32_t> kept(mesh.positions.size());
  std::iota(kept.begin(), kept.end(), 0);
  const auto root = [&](std::int32_t v) {
    while (kept[static_cast<std::size_t>(v)] != v) v = kept[static_cast<std::size_t>(v)];
    return v;
  };
  std::int64_t merged = 0;
  for (const ClosePair& pair : pairs) {
    const std::int32_t a = root(pair.kept);
    const std::int32_t b = root(pair.gone);
    // Chains of close vertices must not pull together what is far apart.
    if (a == b || distance(at(a), at(b)) > state.tolerance) continue;
    kept[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    note(item, std::max(a, b));
    ++merged;
  }
  if (!state.modify) return 0;
  EditSoup soup(state);
  for (std::size_t v = 0; v < kept.size(); ++v) {
    if (kept[v] != static_cast<std::int32_t>(v)) {
      soup.merge(root(static_cast<std::int32_t>(v)), static_cast<std::int32_t>(v));
    }
  }
  soup.finish();
  return merged;
}

/// Boundary vertices on a boundary edge that they don't belong to, by their place along it.
std::vector<std::pair<double, std::int32_t>> verticesOn(const TriangleMesh& mesh, const PointGrid& grid,
                                                        const std::array<std::int32_t, 2>& edge, double tolerance) {
  const Vec3& a = mesh.positions[static_cast<std::size_t>(edge[0])];
  const Vec3& b = mesh.positions[static_cast<std::size_t>(edge[1])];
  const double length = distance(a, b);
  const Vec3 direction = normalized(b - a);
  std::vector<std::pair<double, std::int32_t>> found;
  // Steps of half a cell, so that no point within half a cell of the edge is missed.
  const double steps = std::ceil(2.0 * length / grid.cell());
  for (double i = 0.0; i <= steps; i += 1.0) {
    grid.forEachNear(a + (b - a) * (i / std::fmax(steps, 1.0)), [&](std::int32_t v) {
      if (v == edge[0] || v == edge[1]) return;
      const Vec3 offset = mesh.positions[static_cast<std::size_t>(v)] - a;
      const double along = dot(offset, direction);
      if (along <= tolerance || along >= length - tolerance) return;
      if (norm(offset - direction * along) <= tolerance) found.emplace_back(along, v);
    });
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Splits boundary edges at the boundary vertices that lie on them. Returns how many splits were made.
std::int64_t splitAtJunctions(RepairState& state, const Boundary& boundary, RepairItem& item) {
  double total = 0.0;
  for (const auto& [a, b] : boundary.edges) {
    total +=
        distance(state.mesh.positions[static_cast<std::size_t>(a)], state.mesh.positions[static_cast<std::size_t>(b)]);
  }
  const double cell = std::fmax(4.0 * state.tolerance, total / static_cast<double>(boundary.edges.size()));
  const PointGrid grid(state.mesh.positions, boundary.vertices, cell);
  std::vector<std::pair<std::array<std::int32_t, 2>, std::vector<std::pair<double, std::int32_t>>>> splits;
  for (const auto& edge : boundary.edges) {
    auto found = verticesOn(state.mesh, grid, edge, state.tolerance);
    for (const auto& [along, v] : found) note(item, v);
    if (!found.empty()) splits.emplace_back(edge, std::move(found));
  }
  if (splits.empty() || !state.modify) return 0;
  EditSoup soup(state);
  for (const auto& [edge, found] : splits) {
    std::int32_t from = edge[0];
    for (const auto& [along, v] : found) {
      soup.splitEdge(from, edge[1], v);
      from = v;
    }
  }
  soup.finish();
  return static_cast<std::int64_t>(splits.size());
}

}  // namespace

void closeGaps(RepairState& state) {
  RepairItem gaps{"nearlyEqualVertices", state.modify ? "merged" : "found", 0, {}};
  RepairItem junctions{"tJunctions", state.modify ? "edge split at the vertex on it" : "found", 0, {}};
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    Boundary boundary = findBoundary(state.mesh);
    if (boundary.edges.empty()) break;
    const std::int64_t merged = weldBoundary(state, boundary, gaps);
    if (merged > 0) boundary = findBoundary(state.mesh);
    if (boundary.edges.empty()) break;
    const std::int64_t split = splitAtJunctions(state, boundary, junctions);
    if (merged + split == 0) break;
  }
  addItem(state, std::move(gaps));
  addItem(state, std::move(junctions));
}

}  // namespace qmcf::detail
