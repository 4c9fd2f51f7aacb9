#include "triangle_ways.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <set>
#include <utility>

#include "qmcf/mesh/element_shape.hpp"
#include "untangle.hpp"

namespace qmcf {
namespace {

/// Relaxation hardly turns back what is turned over in the beginning: shapes below the first cost this much more.
constexpr double kPoorShape = 0.2;
constexpr double kPoorCost = 10.0;
/// What one more quadrilateral costs whatever its shape.
constexpr double kStepCost = 0.02;

/// What a quadrilateral and the triangle beside it become.
struct Hop {
  std::array<VertexId, 4> quad{};
  VertexId apex;  ///< Of the triangle that is left, over the edge by which the way goes on.
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

/// Dijkstra's search for ways from one triangle to others.
class WaySearch {
 public:
  WaySearch(const EditMesh& mesh, FaceId from, double mostCost) : mesh_(mesh), mostCost_(mostCost), ends_{from} {
    for (const HalfedgeId h : mesh.sides(from)) {
      if (h.valid()) push(0.0, {h, apexOver(mesh, h), kNothing, {}});
    }
  }

  std::vector<TriangleWay> run(std::size_t most) {
    std::vector<TriangleWay> ways;
    while (!queue_.empty() && ways.size() < most) {
      const auto [cost, at] = queue_.top();
      queue_.pop();
      const Step here = steps_[at];
      if (!done_.emplace(here.crossed, here.apex).second) continue;
      const FaceId face = mesh_.face(here.crossed);
      if (here.isEnd) {
        TriangleWay way = wayTo(at);
        if (way.crossed.empty() || std::find(ends_.begin(), ends_.end(), face) != ends_.end()) continue;
        ends_.push_back(face);
        ways.push_back(std::move(way));
        continue;
      }
      goOn(cost, at);
    }
    return ways;
  }

 private:
  static constexpr std::size_t kNothing = std::numeric_limits<std::size_t>::max();

  /// A half-edge that is to be crossed next, with a triangle left behind it: the apex of that may be either of the
  /// face's other two vertices.
  struct Step {
    HalfedgeId crossed;  ///< At the end: the one that was entered by.
    VertexId apex;
    std::size_t before = kNothing;   ///< Index of the step before.
    std::array<VertexId, 4> quad{};  ///< Made since then.
    bool isEnd = false;
  };
  using Entry = std::pair<double, std::size_t>;  // cost, index of the step

  void push(double cost, const Step& step) {
    if (cost > mostCost_ || !mesh_.twin(step.crossed).valid() || done_.contains({step.crossed, step.apex})) return;
    queue_.emplace(cost, steps_.size());
    steps_.push_back(step);
  }

  void goOn(double cost, std::size_t at) {
    const auto [crossed, apex, before, quad, isEnd] = steps_[at];
    const HalfedgeId entry = mesh_.twin(crossed);
    if (mesh_.cornerCount(mesh_.face(entry)) == 3) {
      const std::array<VertexId, 4> last{apex, mesh_.origin(crossed), apexOver(mesh_, entry), mesh_.target(crossed)};
      push(cost + costOf(mesh_, last), {entry, apex, at, last, true});
      return;
    }
    for (const HalfedgeId next : {mesh_.next(entry), mesh_.next(mesh_.next(entry)), mesh_.prev(entry)}) {
      for (const bool fromOrigin : {false, true}) {
        if (!separates(mesh_, crossed, next, fromOrigin)) continue;
        const Hop step = hop(mesh_, apex, crossed, next, fromOrigin);
        push(cost + kStepCost + costOf(mesh_, step.quad), {next, step.apex, at, step.quad});
      }
    }
  }

  /// The way that ends with a step; empty if it passes through a face twice.
  [[nodiscard]] TriangleWay wayTo(std::size_t end) const {
    TriangleWay way;
    std::vector<FaceId> faces{mesh_.face(steps_[end].crossed)};
    for (std::size_t i = end; steps_[i].before != kNothing; i = steps_[i].before) {
      way.quads.push_back(steps_[i].quad);
      way.crossed.push_back(steps_[steps_[i].before].crossed);
      faces.push_back(mesh_.face(way.crossed.back()));
    }
    std::reverse(way.crossed.begin(), way.crossed.end());
    std::reverse(way.quads.begin(), way.quads.end());
    std::sort(faces.begin(), faces.end());
    return std::adjacent_find(faces.begin(), faces.end()) == faces.end() ? way : TriangleWay{};
  }

  const EditMesh& mesh_;
  double mostCost_;
  std::vector<FaceId> ends_;  ///< Triangles that a way was found to, and the first one.
  std::vector<Step> steps_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
  std::set<std::pair<HalfedgeId, VertexId>> done_;
};

}  // namespace

std::vector<TriangleWay> waysToTriangles(const EditMesh& mesh, FaceId from, std::size_t most, double mostCost) {
  return WaySearch(mesh, from, mostCost).run(most);
}

bool mergeAlong(EditMesh& mesh, const TriangleWay& way) {
  for (std::size_t i = 0; i < way.crossed.size(); ++i) {
    const HalfedgeId crossed = way.crossed[i];
    if (way.quads[i][0] == way.quads[i][2]) return false;
    if (i + 1 < way.crossed.size()) {
      const HalfedgeId entry = mesh.twin(crossed);
      // The half beside the edge that is crossed has the far corner of the new quadrilateral.
      const HalfedgeId from = mesh.origin(mesh.prev(entry)) == way.quads[i][2] ? mesh.next(entry) : entry;
      const HalfedgeId to = mesh.next(mesh.next(from));
      if (mesh.connected(mesh.origin(from), mesh.origin(to))) return false;
      mesh.cut(from, to);
    }
    joinTriangles(mesh, crossed);
  }
  return true;
}

}  // namespace qmcf
