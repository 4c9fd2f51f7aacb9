// Gaps between pieces that were meant to join: boundary vertices at almost the same place are merged, and where a
// boundary vertex lies on another boundary edge (a T-junction) that edge is split there. Only boundaries are touched,
// so a closed surface stays as it is however small its details are.

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

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

/// All pairs of these vertices up to `radius` apart, closest first. Stops as soon as there are more than `most`.
std::vector<ClosePair> closePairs(const std::vector<Vec3>& positions, const std::vector<std::int32_t>& vertices,
                                  double radius, std::size_t most) {
  const PointGrid grid(positions, vertices, radius);
  const auto at = [&](std::int32_t v) -> const Vec3& { return positions[static_cast<std::size_t>(v)]; };
  std::vector<ClosePair> pairs;
  for (const std::int32_t v : vertices) {
    grid.forEachNear(at(v), [&](std::int32_t w) {
      if (w <= v) return;
      const double apart = distance(at(v), at(w));
      if (apart <= radius) pairs.push_back({apart, v, w});
    });
    if (pairs.size() > most) return pairs;
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Which vertices become one.
class Merging {
 public:
  explicit Merging(const std::vector<Vec3>& positions) : positions_(positions), kept_(positions.size()) {
    std::iota(kept_.begin(), kept_.end(), 0);
  }

  [[nodiscard]] std::int32_t root(std::int32_t v) const {
    while (!isKept(v)) v = kept_[static_cast<std::size_t>(v)];
    return v;
  }
  [[nodiscard]] bool isKept(std::int32_t v) const { return kept_[static_cast<std::size_t>(v)] == v; }

  /// Returns the vertex that goes; kNone where both are one already, or what they stand for is farther apart: chains of
  /// close vertices must not pull together what is.
  std::int32_t merge(std::int32_t v, std::int32_t w, double tolerance) {
    const std::int32_t a = root(v);
    const std::int32_t b = root(w);
    if (a == b) return kNone;
    const Vec3& p = positions_[static_cast<std::size_t>(a)];
    if (distance(p, positions_[static_cast<std::size_t>(b)]) > tolerance) return kNone;
    kept_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    return std::max(a, b);
  }

 private:
  const std::vector<Vec3>& positions_;
  std::vector<std::int32_t> kept_;
};

/// Merges boundary vertices within the tolerance, closest pairs first. Returns how many went.
///
/// Where the tolerance is larger than the part's details, each vertex has a great many others within it. Then those
/// within a smaller radius come first. What is left of them is farther apart than that and so has few neighbours within
/// twice the radius, and so on.
std::int64_t weldBoundary(RepairState& state, const Boundary& boundary, RepairItem& item) {
  constexpr std::size_t kManyPairs = 32;  // Per vertex.
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  constexpr int kHalvings = 40;
  const TriangleMesh& mesh = state.mesh;
  std::vector<std::int32_t> vertices = boundary.vertices;
  double radius = state.tolerance;
  std::size_t most = kManyPairs * vertices.size();
  std::vector<ClosePair> pairs = closePairs(mesh.positions, vertices, radius, most);
  for (int halving = 1; pairs.size() > most; ++halving) {
    radius *= 0.5;
    if (halving == kHalvings) most = kAll;
    pairs = closePairs(mesh.positions, vertices, radius, most);
  }
  Merging merging(mesh.positions);
  std::int64_t merged = 0;
  while (true) {
    for (const ClosePair& pair : pairs) {
      const std::int32_t gone = merging.merge(pair.kept, pair.gone, state.tolerance);
      if (gone == kNone) continue;
      note(item, gone);
      ++merged;
    }
    if (radius >= state.tolerance) break;
    radius = std::min(2.0 * radius, state.tolerance);
    std::erase_if(vertices, [&](std::int32_t v) { return !merging.isKept(v); });
    pairs = closePairs(mesh.positions, vertices, radius, kAll);
  }
  if (merged == 0 || !state.modify) return 0;
  EditSoup soup(state);
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.positions.size()); ++v) {
    if (!merging.isKept(v)) soup.merge(merging.root(v), v);
  }
  soup.finish();
  return merged;
}

/// Of these boundary vertices, as they are in the grid, those on a boundary edge that they don't belong to, by their
/// place along it.
std::vector<std::pair<double, std::int32_t>> verticesOn(const TriangleMesh& mesh, const PointGrid& grid,
                                                        const std::vector<std::int32_t>& vertices,
                                                        const std::array<std::int32_t, 2>& edge, double tolerance) {
  const Vec3& a = mesh.positions[static_cast<std::size_t>(edge[0])];
  const Vec3& b = mesh.positions[static_cast<std::size_t>(edge[1])];
  const double length = distance(a, b);
  const Vec3 direction = normalized(b - a);
  std::vector<std::pair<double, std::int32_t>> found;
  const auto test = [&](std::int32_t v) {
    if (v == edge[0] || v == edge[1]) return;
    const Vec3 offset = mesh.positions[static_cast<std::size_t>(v)] - a;
    const double along = dot(offset, direction);
    if (along <= tolerance || along >= length - tolerance) return;
    if (norm(offset - direction * along) <= tolerance) found.emplace_back(along, v);
  };
  // Steps of half a cell, so that no point within half a cell of the edge is missed.
  const double steps = std::ceil(2.0 * length / grid.cell());
  if (steps > static_cast<double>(vertices.size())) {
    for (const std::int32_t v : vertices) test(v);
  } else {
    for (double i = 0.0; i <= steps; i += 1.0) grid.forEachNear(a + (b - a) * (i / std::fmax(steps, 1.0)), test);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// The mean length of the boundary edges without a few that may be far longer than all others.
double usualLength(const TriangleMesh& mesh, const Boundary& boundary) {
  constexpr std::size_t kFew = 16;
  std::vector<double> lengths;
  for (const auto& [a, b] : boundary.edges) {
    lengths.push_back(
        distance(mesh.positions[static_cast<std::size_t>(a)], mesh.positions[static_cast<std::size_t>(b)]));
  }
  std::sort(lengths.begin(), lengths.end());
  if (lengths.size() > 2 * kFew) lengths.resize(lengths.size() - kFew);
  return std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
}

/// Splits boundary edges at the boundary vertices that lie on them. Returns how many splits were made.
std::int64_t splitAtJunctions(RepairState& state, const Boundary& boundary, RepairItem& item) {
  const double cell = std::fmax(4.0 * state.tolerance, usualLength(state.mesh, boundary));
  const PointGrid grid(state.mesh.positions, boundary.vertices, cell);
  std::vector<std::pair<std::array<std::int32_t, 2>, std::vector<std::pair<double, std::int32_t>>>> splits;
  for (const auto& edge : boundary.edges) {
    auto found = verticesOn(state.mesh, grid, boundary.vertices, edge, state.tolerance);
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
