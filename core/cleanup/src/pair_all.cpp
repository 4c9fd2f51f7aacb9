// What is done about the last triangles where none may be left: quadrilaterals at any price that leaves elements which
// solvers take.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "cavity.hpp"
#include "operators.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/mesh/loop_fillings.hpp"
#include "triangle_ways.hpp"

namespace qmcf {
namespace {

/// At first only good shapes will do, in the end any.
constexpr std::array<double, 3> kLeastShapes{0.3, 0.15, 0.05};
/// How many ways to other triangles are tried from each, of any length, and how many fillings of what lies between two.
constexpr std::size_t kMostWays = 6;
constexpr std::size_t kMostFillings = 8;
/// Elements between and beside two triangles that are filled anew with them.
constexpr std::size_t kMostAdded = 3;
constexpr std::size_t kLongestLoop = 10;
/// Poor quadrilaterals that a way may leave and that are filled anew then.
constexpr std::size_t kMostMended = 6;
constexpr int kSettleSweeps = 8;
/// Least sine at a corner, before anything has moved, that relaxation won't make good; and how many fillings are tried
/// for a pair of triangles.
constexpr double kHopeless = -0.3;
constexpr std::size_t kMostFills = 100;
constexpr double kShareBefore = 0.7;  ///< Of the progress of a clean-up.

/// The least sine at a corner of the cells, as seen along the normal.
double leastSine(const std::vector<std::array<int, 4>>& cells, const std::vector<Vec3>& positions, const Vec3& normal) {
  double least = 1.0;
  for (const auto& cell : cells) {
    const auto p = [&](std::size_t i) -> const Vec3& { return positions[static_cast<std::size_t>(cell[i % 4])]; };
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const Vec3 ahead = p(i + 1) - p(i);
      const Vec3 back = p(i + 3) - p(i);
      const double lengths = norm(ahead) * norm(back);
      least = std::min(least, lengths > 0.0 ? dot(cross(ahead, back), normal) / lengths : -1.0);
    }
  }
  return least;
}

/// Quadrilaterals in a loop of vertices: corners as indices into the outline and, from its length on, the inner ones.
struct Filling {
  std::vector<std::array<int, 4>> cells;
  std::vector<Vec3> inner;
  double leastSine = 0.0;
};

/// The ways of filling an outline, the best shaped first.
std::vector<Filling> fillingsOf(const std::vector<Vec3>& outline, const Vec3& normal) {
  const std::size_t length = outline.size();
  Vec3 centre;
  for (const Vec3& p : outline) centre += p / static_cast<double>(length);
  std::vector<Filling> ways;
  for (const LoopFilling& way : loopFillings(static_cast<int>(length))) {
    ways.push_back({way.cells, way.hasMiddle ? std::vector{centre} : std::vector<Vec3>{}, 0.0});
  }
  // A tip one element wide: two columns with a vertex between each of the first two pairs of nodes. They end across the
  // third node of one side, or in another tip.
  for (int tip = 0; length == 6 && tip < 6; ++tip) {
    const auto at = [tip](int i) { return (tip + i) % 6; };
    const auto between = [&](int i, int j) {
      return (outline[static_cast<std::size_t>(at(i))] + outline[static_cast<std::size_t>(at(j))]) * 0.5;
    };
    // Off the lines across, or both ends would have straight corners.
    constexpr double kOff = 0.25;
    const Vec3 near = between(1, 5);
    const Vec3 far = between(2, 4);
    const std::vector<Vec3> inner{near + (far - near) * kOff, far + (near - far) * kOff};
    const std::array<int, 4> kite{at(0), at(1), 6, at(5)};
    const std::array<int, 4> left{at(5), 6, 7, at(4)};
    const std::array<int, 4> right{6, at(1), at(2), 7};
    ways.push_back({{kite, left, right, {at(4), 7, at(2), at(3)}}, inner, 0.0});
    if (tip < 3) ways.push_back({{kite, left, right, {7, at(2), at(3), at(4)}}, inner, 0.0});
  }
  for (Filling& way : ways) {
    std::vector<Vec3> positions = outline;
    positions.insert(positions.end(), way.inner.begin(), way.inner.end());
    way.leastSine = leastSine(way.cells, positions, normal);
  }
  std::stable_sort(ways.begin(), ways.end(),
                   [](const Filling& a, const Filling& b) { return a.leastSine > b.leastSine; });
  return ways;
}

}  // namespace

/// Fills cavity_ with quadrilaterals, whatever becomes of the energy, if none of them or around them is worse than
/// `least`. Commits nothing.
bool TopologicalCleanup::fillAnyhow(double least) {
  const auto loop = cavity_.boundaryLoop(mesh_);
  if (!loop || loop->size() > kLongestLoop) return false;
  std::vector<VertexId> vertices;
  std::vector<Vec3> outline;
  Vec3 normal;
  for (const HalfedgeId h : *loop) {
    vertices.push_back(mesh_.origin(h));
    outline.push_back(mesh_.position(vertices.back()));
    normal += mesh_.normal(vertices.back());
  }
  const std::vector<Filling> ways = fillingsOf(outline, normalized(normal));
  for (std::size_t i = 0; i < std::min(ways.size(), kMostFillings); ++i) {
    if (ways[i].leastSine < kHopeless || fillsLeft_ == 0) return false;
    --fillsLeft_;
    if (cavity_.doublesEdge(mesh_, *loop, ways[i].cells)) continue;
    std::vector<EditMesh::Vertex> inner;
    for (const Vec3& p : ways[i].inner) inner.push_back(projectVertex(target_, mesh_.vertex(vertices[0]), p));
    const std::size_t mark = mesh_.mark();
    mesh_.fill(*loop, cavity_.faces(), ways[i].cells, inner);
    if (becomesGood(vertices, least, kSettleSweeps)) return true;
    mesh_.rollback(mark);
  }
  return false;
}

/// Fills the faces anew, if need be with up to so many quadrilaterals beside them. Commits nothing.
bool TopologicalCleanup::fillWithBeside(std::vector<FaceId>& faces, std::size_t most, double least) {
  cavity_.clear();
  for (const FaceId f : faces) cavity_.add(f);
  if (fillAnyhow(least)) return true;
  if (most == 0) return false;
  std::vector<FaceId> beside;
  for (const FaceId f : faces) {
    for (const HalfedgeId h : mesh_.sides(f)) {
      if (h.valid() && mesh_.twin(h).valid()) beside.push_back(mesh_.face(mesh_.twin(h)));
    }
  }
  for (const FaceId f : beside) {
    if (std::find(faces.begin(), faces.end(), f) != faces.end() || mesh_.cornerCount(f) != 4) continue;
    faces.push_back(f);
    if (fillWithBeside(faces, most - 1, least)) return true;
    faces.pop_back();
  }
  return false;
}

/// Fills the quadrilaterals around the vertices that are worse than `least` anew, with those beside them. Returns
/// whether none is left. Commits nothing.
bool TopologicalCleanup::mendPoor(const std::vector<VertexId>& vertices, double least) {
  for (std::size_t round = 0;; ++round) {
    std::vector<FaceId> poor = facesAround(mesh_, vertices);
    std::erase_if(poor, [&](FaceId f) { return faceShape(mesh_, f) >= least; });
    if (poor.empty()) return true;
    if (round + poor.size() > kMostMended || mesh_.cornerCount(poor[0]) != 4) return false;
    poor.resize(1);
    if (!fillWithBeside(poor, kMostAdded, least)) return false;
  }
}

void TopologicalCleanup::pairAll(Progress& progress) {
  if (countElements(mesh_).triangles > kFewTriangles) return;
  note(TraceKind::pair);
  for (const double least : kLeastShapes) {
    for (std::size_t i = 0; i < mesh_.faceCapacity(); ++i) {
      const FaceId f(i);
      if (mesh_.kind(f) == FaceKind::removed || mesh_.cornerCount(f) != 3) continue;
      if (!progress.report(Stage::cleanup, kShareBefore)) return;
      for (const TriangleWay& way : waysToTriangles(mesh_, f, kMostWays, HUGE_VAL)) {
        fillsLeft_ = kMostFills;
        if (joinAlong(way, {least, true})) break;
        if (way.crossed.size() > kMostAdded + 1) continue;
        std::vector<FaceId> faces{mesh_.face(mesh_.twin(way.crossed.back()))};
        for (const HalfedgeId h : way.crossed) faces.push_back(mesh_.face(h));
        const double lowest = std::min(least, worstAround(mesh_, cornersOf(mesh_, faces)));
        if (!fillWithBeside(faces, kMostAdded + 1 - way.crossed.size(), lowest)) continue;
        mesh_.commit();
        ++statistics_.pairs;
        break;
      }
    }
    if (countElements(mesh_).triangles == 0) return;
  }
}

}  // namespace qmcf
