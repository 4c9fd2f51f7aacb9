#include "mend_quads.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "cavity.hpp"
#include "qmcf/mesh/loop_fillings.hpp"
#include "stand.hpp"

namespace qmcf {
namespace {

/// The fan of a vertex with more elements is not filled anew.
constexpr std::size_t kLargestFan = 4;
/// Changes whose vertices are moved to see what they are worth.
constexpr std::size_t kTries = 8;
constexpr int kSettleSweeps = 3;
/// A change that turns no element back is made if it lowers the penalty by so much.
constexpr double kWorthwhile = 0.05;

/// A way to change the quads around one: some of them filled anew, or one closed along a diagonal.
struct Change {
  std::vector<FaceId> faces;
  const LoopFilling* filling = nullptr;
  HalfedgeId corner;  ///< Of the quad to close: the corner that the opposite one moves into.
  /// The vertices that it touches; their elements are what it is judged by.
  std::vector<VertexId> vertices;
  Damage gained;  ///< What it leaves less what was there.
};

bool isBetter(const Change& a, const Change& b) { return a.gained < b.gained; }

class QuadMender {
 public:
  QuadMender(EditMesh& mesh, const RelaxationTarget& target) : mesh_(mesh), target_(target) {}

  /// Makes the change that helps the quad most, if one does.
  bool mend(FaceId quad) {
    changes_.clear();
    for (const HalfedgeId h : mesh_.sides(quad)) {
      const Change change = closing(h);
      consider(change, damageAround(mesh_, target_, change.vertices));
    }
    for (const std::vector<FaceId>& faces : cavitiesAround(quad)) {
      const auto loop = loopAround(faces);
      if (!loop) continue;
      Change change{faces, nullptr, {}, {}, {}};
      for (const HalfedgeId h : *loop) change.vertices.push_back(mesh_.origin(h));
      const Damage before = damageAround(mesh_, target_, change.vertices);
      for (const LoopFilling& filling : loopFillings(static_cast<int>(loop->size()))) {
        change.filling = &filling;
        consider(change, before);
      }
    }
    return makeBest();
  }

 private:
  /// Puts the change among those to be tried if it is one of the best so far. before: the damage around its vertices.
  void consider(const Change& change, const Damage& before) {
    const std::size_t mark = mesh_.mark();
    if (apply(change)) {
      Change candidate = change;
      candidate.gained = gain(before, change.vertices, changes_.size() < kTries ? kAnyDamage : worthTrying(before));
      changes_.insert(std::upper_bound(changes_.begin(), changes_.end(), candidate, isBetter), candidate);
      if (changes_.size() > kTries) changes_.pop_back();
    }
    mesh_.rollback(mark);
  }

  /// What a change must leave less than to be better than the last of those to be tried, give or take round-off.
  [[nodiscard]] Damage worthTrying(const Damage& before) const {
    constexpr double kRoundOff = 1e-12;
    const Damage& last = changes_.back().gained;
    const double penalty = before.penalty + last.penalty;
    return {before.turnedOver + last.turnedOver, penalty + kRoundOff * (before.penalty + std::fabs(last.penalty))};
  }

  /// Tries the changes with the vertices moved, and makes the best of them if elements stand better then.
  bool makeBest() {
    for (Change& change : changes_) change.vertices = withNeighbours(change.vertices);
    const auto make = [this](const Change& change) {
      if (!apply(change)) return false;
      settle(change.vertices);
      return true;
    };
    for (Change& change : changes_) {
      const std::size_t mark = mesh_.mark();
      const Damage before = damageAround(mesh_, target_, change.vertices);
      if (make(change)) change.gained = gain(before, change.vertices);
      mesh_.rollback(mark);
    }
    const auto best = std::min_element(changes_.begin(), changes_.end(), isBetter);
    return best != changes_.end() && isWorthwhile(best->gained) && make(*best);
  }

  [[nodiscard]] static bool isWorthwhile(const Damage& gained) {
    return gained.turnedOver < 0 || (gained.turnedOver == 0 && gained.penalty < -kWorthwhile);
  }

  [[nodiscard]] std::vector<VertexId> withNeighbours(const std::vector<VertexId>& vertices) const {
    std::vector<VertexId> all = vertices;
    for (const VertexId v : vertices) {
      mesh_.forEachOutgoing(v, [&](HalfedgeId h) { all.push_back(mesh_.target(h)); });
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /// What there is more of than before; if there isn't less than `most`, it may be any less than the truth.
  [[nodiscard]] Damage gain(const Damage& before, const std::vector<VertexId>& vertices,
                            const Damage& most = kAnyDamage) const {
    const Damage after = damageAround(mesh_, target_, vertices, most);
    return {after.turnedOver - before.turnedOver, after.penalty - before.penalty};
  }

  /// The quad with a neighbour, in a row of three around one of its corners, or in the fan of that.
  [[nodiscard]] std::vector<std::vector<FaceId>> cavitiesAround(FaceId quad) const {
    std::vector<std::vector<FaceId>> cavities;
    for (const HalfedgeId h : mesh_.sides(quad)) {
      if (mesh_.twin(h).valid()) cavities.push_back({quad, mesh_.face(mesh_.twin(h))});
      std::vector<FaceId> fan;
      mesh_.forEachOutgoing(mesh_.origin(h), [&](HalfedgeId out) { fan.push_back(mesh_.face(out)); });
      const bool isClosed = !mesh_.isBoundary(mesh_.origin(h));
      const auto place = static_cast<std::size_t>(std::find(fan.begin(), fan.end(), quad) - fan.begin());
      for (std::size_t from = 0; from < 3; ++from) {
        // Three in a row, the quad among them.
        std::vector<FaceId> row;
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t at = place + from + i;
          if (isClosed) row.push_back(fan[(at + fan.size() - 2) % fan.size()]);
          if (!isClosed && at >= 2 && at - 2 < fan.size()) row.push_back(fan[at - 2]);
        }
        if (row.size() == 3 && fan.size() > 3) cavities.push_back(row);
      }
      if (isClosed && fan.size() <= kLargestFan) cavities.push_back(fan);
    }
    std::erase_if(cavities, [this](const std::vector<FaceId>& faces) { return !allQuads(mesh_, faces); });
    return cavities;
  }

  [[nodiscard]] std::optional<std::vector<HalfedgeId>> loopAround(const std::vector<FaceId>& faces) {
    cavity_.clear();
    for (const FaceId f : faces) cavity_.add(f);
    return cavity_.boundaryLoop(mesh_);
  }

  /// Closing the quad of a half-edge by moving the corner opposite to its origin into that.
  [[nodiscard]] Change closing(HalfedgeId corner) const {
    Change change{{}, nullptr, corner, {mesh_.origin(corner)}, {}};
    const VertexId opposite = mesh_.origin(mesh_.next(mesh_.next(corner)));
    mesh_.forEachOutgoing(opposite, [&](HalfedgeId h) { change.vertices.push_back(mesh_.target(h)); });
    change.vertices.push_back(opposite);
    return change;
  }

  /// Returns whether the change can be made.
  bool apply(const Change& change) { return change.filling != nullptr ? refill(change) : close(change.corner); }

  bool close(HalfedgeId corner) {
    const HalfedgeId opposite = mesh_.next(mesh_.next(corner));
    const VertexId kept = mesh_.origin(corner);
    const Vec3 middle = (mesh_.position(kept) + mesh_.position(mesh_.origin(opposite))) * 0.5;
    if (mesh_.connected(kept, mesh_.origin(opposite))) return false;
    const HalfedgeId diagonal = mesh_.cut(corner, opposite);
    if (!mesh_.canCollapse(diagonal)) return false;
    mesh_.collapse(diagonal);
    if (!mesh_.isBoundary(kept)) mesh_.setVertex(kept, projectVertex(target_, mesh_.vertex(kept), middle));
    return true;
  }

  bool refill(const Change& change) {
    const auto loop = loopAround(change.faces);
    if (cavity_.doublesEdge(mesh_, *loop, change.filling->cells)) return false;
    Vec3 centre;
    for (const HalfedgeId h : *loop) centre += mesh_.position(mesh_.origin(h)) / static_cast<double>(loop->size());
    std::vector<EditMesh::Vertex> inner;
    if (change.filling->hasMiddle)
      inner.push_back(projectVertex(target_, mesh_.vertex(mesh_.origin(loop->front())), centre));
    mesh_.fill(*loop, change.faces, change.filling->cells, inner);
    return true;
  }

  void settle(const std::vector<VertexId>& vertices) {
    std::vector<VertexId> moving;
    for (const VertexId v : vertices) {
      if (mesh_.alive(v) && !mesh_.isBoundary(v)) moving.push_back(v);
    }
    for (std::size_t v = vertexCount_; v < mesh_.vertexCapacity(); ++v) {
      if (mesh_.alive(VertexId(v))) moving.push_back(VertexId(v));
    }
    // A vertex that found no better place finds none until something around it has moved.
    std::vector<char> awake(moving.size(), 1);
    const auto wake = [&](VertexId v) {
      const auto place = std::lower_bound(moving.begin(), moving.end(), v);
      if (place != moving.end() && *place == v) awake[static_cast<std::size_t>(place - moving.begin())] = 1;
    };
    for (int sweep = 0; sweep < kSettleSweeps; ++sweep) {
      for (std::size_t i = 0; i < moving.size(); ++i) {
        if (awake[i] == 0) continue;
        awake[i] = 0;
        if (!moveToBest(mesh_, target_, moving[i])) continue;
        mesh_.forEachOutgoing(moving[i], [&](HalfedgeId h) {
          for (const HalfedgeId side : mesh_.sides(mesh_.face(h))) {
            if (side.valid()) wake(mesh_.origin(side));
          }
        });
      }
    }
  }

  EditMesh& mesh_;
  const RelaxationTarget& target_;
  Cavity cavity_;
  std::vector<Change> changes_;  ///< To be tried, the best first.
  std::size_t vertexCount_ = mesh_.vertexCapacity();
};

}  // namespace

bool mendQuads(EditMesh& mesh, const RelaxationTarget& target) {
  bool helped = false;
  for (std::size_t i = 0; i < mesh.faceCapacity(); ++i) {
    const FaceId f(i);
    if (mesh.kind(f) == FaceKind::removed || mesh.cornerCount(f) != 4 || !standOf(mesh, target, f).turnedOver) continue;
    helped = QuadMender(mesh, target).mend(f) || helped;
    mesh.commitUnwatched();
  }
  mesh.commit();
  return helped;
}

}  // namespace qmcf
