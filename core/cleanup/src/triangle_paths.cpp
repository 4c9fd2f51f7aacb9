#include "triangle_paths.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "qmcf/mesh/element_shape.hpp"

namespace qmcf {
namespace {

/// A row can be sheared by one element without an irregular vertex, where a path turns there are two.
constexpr double kTurnCost = 2.0;
constexpr double kLongestPath = 25.0;
/// Relaxation hardly turns back what is turned over in the beginning: shapes below the first cost this much more.
constexpr double kPoorShape = 0.2;
constexpr double kPoorCost = 10.0;

/// What a quadrilateral and the triangle beside it become.
struct Hop {
  std::array<VertexId, 4> quad{};
  VertexId apex;  ///< Of the triangle that is left, over the edge by which the path goes on.
};

/// Of the triangle with an apex over `crossed` and the quadrilateral behind that, with the diagonal from the origin or
/// from the target of `crossed`.
Hop hop(const EditMesh& mesh, VertexId apex, HalfedgeId crossed, HalfedgeId next, bool fromOrigin) {
  const HalfedgeId entry = mesh.twin(crossed);
  const VertexId o = mesh.origin(crossed);
  const VertexId t = mesh.target(crossed);
  const VertexId p = mesh.target(mesh.next(entry));
  const VertexId q = mesh.origin(mesh.prev(entry));
  if (fromOrigin) return {{apex, o, q, t}, next == mesh.next(entry) ? q : o};
  return {{apex, o, p, t}, next == mesh.prev(entry) ? p : t};
}

/// Whether the edges by which a quadrilateral is entered and left are on different sides of the diagonal.
bool separates(const EditMesh& mesh, HalfedgeId crossed, HalfedgeId next, bool fromOrigin) {
  const HalfedgeId entry = mesh.twin(crossed);
  return fromOrigin ? next != mesh.prev(entry) : next != mesh.next(entry);
}

double costOf(const EditMesh& mesh, const std::array<VertexId, 4>& quad) {
  const double shape = quadShape(mesh, quad);
  const double lack = 1.0 - shape;
  return lack * lack + kPoorCost * std::max(0.0, kPoorShape - shape);
}

VertexId apexOver(const EditMesh& mesh, HalfedgeId side) { return mesh.origin(mesh.prev(side)); }

/// Turns the half-edges from a search tree into a path; empty if it passes through a face twice.
TrianglePath pathTo(const EditMesh& mesh, HalfedgeId last, const std::unordered_map<std::size_t, HalfedgeId>& before) {
  TrianglePath path;
  std::vector<FaceId> faces{mesh.face(mesh.twin(last))};
  for (HalfedgeId h = last; h.valid(); h = before.at(h.index())) {
    path.push_back(h);
    faces.push_back(mesh.face(h));
  }
  std::reverse(path.begin(), path.end());
  std::sort(faces.begin(), faces.end());
  if (std::adjacent_find(faces.begin(), faces.end()) != faces.end()) return {};
  return path;
}

}  // namespace

std::vector<TrianglePath> pathsToTriangles(const EditMesh& mesh, FaceId from, std::size_t most) {
  using Entry = std::tuple<double, std::size_t, std::size_t>;  // cost, half-edge crossed, the one before or itself
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::unordered_map<std::size_t, HalfedgeId> before;
  std::vector<FaceId> reached{from};
  std::vector<TrianglePath> paths;
  for (const HalfedgeId h : mesh.sides(from)) {
    if (h.valid() && mesh.twin(h).valid()) queue.emplace(0.0, h.index(), h.index());
  }
  while (!queue.empty() && paths.size() < most) {
    const auto [cost, at, previous] = queue.top();
    queue.pop();
    const HalfedgeId crossed(at);
    if (!before.emplace(at, previous == at ? HalfedgeId() : HalfedgeId(previous)).second) continue;
    const HalfedgeId entry = mesh.twin(crossed);
    const FaceId face = mesh.face(entry);
    if (mesh.cornerCount(face) == 3) {
      if (std::find(reached.begin(), reached.end(), face) != reached.end()) continue;
      TrianglePath path = pathTo(mesh, crossed, before);
      if (path.empty()) continue;
      reached.push_back(face);
      paths.push_back(std::move(path));
      continue;
    }
    const HalfedgeId ahead = mesh.next(mesh.next(entry));
    for (const HalfedgeId next : {mesh.next(entry), ahead, mesh.prev(entry)}) {
      const double sum = cost + (next == ahead ? 1.0 : kTurnCost);
      if (!mesh.twin(next).valid() || sum > kLongestPath || before.contains(next.index())) continue;
      queue.emplace(sum, next.index(), at);
    }
  }
  return paths;
}

std::vector<std::array<VertexId, 4>> quadsAlong(const EditMesh& mesh, const TrianglePath& crossed) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  /// The best way so far that ends with one of the two diagonals.
  struct Way {
    double cost = kNever;
    VertexId apex;
    std::vector<std::array<VertexId, 4>> quads;
  };
  std::array<Way, 2> ways;
  ways[0] = {0.0, apexOver(mesh, crossed.front()), {}};
  for (std::size_t i = 0; i + 1 < crossed.size(); ++i) {
    std::array<Way, 2> longer;
    for (const bool fromOrigin : {false, true}) {
      if (!separates(mesh, crossed[i], crossed[i + 1], fromOrigin)) continue;
      Way& best = longer[fromOrigin ? 1 : 0];
      for (const Way& way : ways) {
        if (way.cost == kNever) continue;
        const Hop step = hop(mesh, way.apex, crossed[i], crossed[i + 1], fromOrigin);
        const double cost = way.cost + costOf(mesh, step.quad);
        if (!(cost < best.cost)) continue;
        best = {cost, step.apex, way.quads};
        best.quads.push_back(step.quad);
      }
    }
    ways = std::move(longer);
  }
  const HalfedgeId last = crossed.back();
  const VertexId end = apexOver(mesh, mesh.twin(last));
  for (Way& way : ways) {
    if (way.cost == kNever) continue;
    way.quads.push_back({way.apex, mesh.origin(last), end, mesh.target(last)});
    way.cost += costOf(mesh, way.quads.back());
  }
  return ways[1].cost < ways[0].cost ? std::move(ways[1].quads) : std::move(ways[0].quads);
}

}  // namespace qmcf
