#include "operators.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "cavity.hpp"
#include "qmcf/base/random.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/mesh/loop_fillings.hpp"

namespace qmcf {
namespace {

constexpr int kSettleSweeps = 4;
/// Where an element is poor, a change that makes nothing more regular is welcome if the worst shape gains this much.
constexpr double kPoor = 0.4;
constexpr double kWorthwhile = 0.08;
/// Bridges are looked for if there are few triangles, or at most one of so many elements.
constexpr std::int64_t kElementsPerTriangle = 5;

}  // namespace

std::vector<VertexId> withNeighbours(const EditMesh& mesh, const std::vector<VertexId>& vertices) {
  std::vector<VertexId> all = vertices;
  for (const VertexId v : vertices) {
    mesh.forEachOutgoing(v, [&](HalfedgeId h) {
      const auto sides = mesh.sides(mesh.face(h));
      for (const HalfedgeId side : sides) {
        if (side.valid()) all.push_back(mesh.origin(side));
      }
    });
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

double worstAround(const EditMesh& mesh, const std::vector<VertexId>& vertices) {
  double worst = 1.0;
  for (const VertexId v : vertices) worst = std::min(worst, worstShapeAround(mesh, v));
  return worst;
}

ElementCounts countElements(const EditMesh& mesh) {
  ElementCounts counts;
  for (std::size_t i = 0; i < mesh.faceCapacity(); ++i) {
    if (mesh.kind(FaceId(i)) == FaceKind::removed) continue;
    ++counts.elements;
    counts.triangles += mesh.cornerCount(FaceId(i)) == 3 ? 1 : 0;
  }
  return counts;
}

TopologicalCleanup::TopologicalCleanup(EditMesh& mesh, std::vector<std::int32_t> wanted, const RelaxationTarget& target,
                                       const CleanupOptions& options, TraceRecorder* trace)
    : mesh_(mesh), wanted_(std::move(wanted)), target_(target), options_(options), trace_(trace) {}

int TopologicalCleanup::excess(VertexId v) const {
  int elements = 0;
  mesh_.forEachOutgoing(v, [&](HalfedgeId) { ++elements; });
  return elements - (v.index() < wanted_.size() ? wanted_[v.index()] : kRegular);
}

bool TopologicalCleanup::becomesGood(const std::vector<VertexId>& vertices, double least, int sweeps) {
  const std::vector<VertexId> moving = withNeighbours(mesh_, vertices);
  for (int sweep = 0; sweep < sweeps; ++sweep) relax(mesh_, moving, target_, options_.leastShape);
  if (!(worstAround(mesh_, vertices) >= least)) return false;
  touched_.insert(touched_.end(), moving.begin(), moving.end());
  return true;
}

bool TopologicalCleanup::settle(const std::vector<VertexId>& vertices, double least, std::size_t mark) {
  const bool isGood = becomesGood(vertices, least, kSettleSweeps);
  if (isGood) {
    mesh_.commit();
  } else {
    mesh_.rollback(mark);
  }
  return isGood;
}

bool TopologicalCleanup::removeDoublet(VertexId v) {
  if (!mesh_.alive(v) || mesh_.isBoundary(v)) return false;
  cavity_.clear();
  mesh_.forEachOutgoing(v, [&](HalfedgeId h) { cavity_.add(mesh_.face(h)); });
  if (cavity_.size() != 2) return false;
  const auto loop = cavity_.boundaryLoop(mesh_);
  if (!loop || loop->size() < 3 || loop->size() > 4) return false;
  std::vector<VertexId> vertices;
  for (const HalfedgeId h : *loop) vertices.push_back(mesh_.origin(h));
  const std::size_t mark = mesh_.mark();
  const double before = worstAround(mesh_, vertices);
  mesh_.fill(*loop, cavity_.faces(), FaceKind::element);
  if (!settle(vertices, std::min(options_.leastShape, before), mark)) return false;
  ++statistics_.doublets;
  return true;
}

bool TopologicalCleanup::pairTriangles(HalfedgeId h) {
  if (!mesh_.alive(h)) return false;
  const HalfedgeId t = mesh_.twin(h);
  if (!t.valid() || mesh_.cornerCount(mesh_.face(h)) != 3 || mesh_.cornerCount(mesh_.face(t)) != 3) return false;
  const std::vector<HalfedgeId> loop{mesh_.next(h), mesh_.prev(h), mesh_.next(t), mesh_.prev(t)};
  std::vector<VertexId> vertices;
  for (const HalfedgeId side : loop) vertices.push_back(mesh_.origin(side));
  const std::size_t mark = mesh_.mark();
  const double before = worstAround(mesh_, vertices);
  mesh_.fill(loop, {mesh_.face(h), mesh_.face(t)}, FaceKind::element);
  if (!settle(vertices, std::min(options_.leastShape, before), mark)) return false;
  ++statistics_.pairs;
  return true;
}

bool TopologicalCleanup::collapseDiagonal(HalfedgeId corner) {
  if (!mesh_.alive(corner) || mesh_.cornerCount(mesh_.face(corner)) != 4) return false;
  // The quad (a, b, c, d) closes by c moving into a.
  const HalfedgeId opposite = mesh_.next(mesh_.next(corner));
  const VertexId a = mesh_.origin(corner);
  const VertexId b = mesh_.origin(mesh_.next(corner));
  const VertexId c = mesh_.origin(opposite);
  const VertexId d = mesh_.origin(mesh_.prev(corner));
  if (mesh_.isBoundary(c)) return false;
  const auto cost = [&](VertexId v, int e) { return irregularity(mesh_.isBoundary(v), e); };
  const int ea = excess(a);
  const int eb = excess(b);
  const int ec = excess(c);
  const int ed = excess(d);
  // a keeps its elements and gains those of c, less the two halves of the quad; a boundary vertex wants its own number.
  const int merged = ea + (ec + 4) - 2;
  const int before = cost(a, ea) + cost(b, eb) + cost(c, ec) + cost(d, ed);
  if (cost(a, merged) + cost(b, eb - 1) + cost(d, ed - 1) >= before) return false;
  std::vector<VertexId> vertices;
  mesh_.forEachOutgoing(c, [&](HalfedgeId h) { vertices.push_back(mesh_.target(h)); });
  vertices.push_back(a);
  const double worstBefore = worstAround(mesh_, vertices);
  const std::size_t mark = mesh_.mark();
  const HalfedgeId diagonal = mesh_.cut(corner, opposite);
  if (!mesh_.canCollapse(diagonal)) {
    mesh_.rollback(mark);
    return false;
  }
  const Vec3 middle = (mesh_.position(a) + mesh_.position(c)) * 0.5;
  mesh_.collapse(diagonal);
  if (!mesh_.isBoundary(a)) mesh_.setVertex(a, projectVertex(target_, mesh_.vertex(a), middle));
  if (!settle(vertices, std::min(options_.leastShape, worstBefore), mark)) return false;
  ++statistics_.collapses;
  return true;
}

bool TopologicalCleanup::refill() {
  const std::size_t triangles = triangleCount(mesh_, cavity_.faces());
  if (triangles % 2 != 0) return false;
  int energyBefore = kTriangleEnergy * static_cast<int>(triangles);
  // What decides which ways are better: the faces and the elements around their vertices.
  std::uint64_t signature = cavity_.signature();
  for (const VertexId v : cavity_.vertices(mesh_)) {
    const int off = excess(v);
    energyBefore += irregularity(mesh_.isBoundary(v), off);
    signature += Random(static_cast<std::uint64_t>(off) + (static_cast<std::uint64_t>(v.index()) << 32U)).next();
  }
  if (!triedRefills_.insert(signature).second) return false;
  const auto loop = cavity_.boundaryLoop(mesh_);
  if (!loop) return false;
  const auto length = static_cast<int>(loop->size());
  const std::vector<LoopFilling>& ways = loopFillings(length);
  if (ways.empty()) return false;
  std::vector<VertexId> vertices;
  std::vector<int> outside;
  for (const HalfedgeId h : *loop) {
    const VertexId v = mesh_.origin(h);
    vertices.push_back(v);
    outside.push_back(excess(v) - cavity_.countAround(mesh_, v));
  }
  std::vector<std::pair<int, std::size_t>> better;
  std::optional<bool> isPoor;  // Known when first asked for: it takes longer than all the rest.
  std::vector<char> isBoundary(vertices.size() + 1, 0);
  for (std::size_t i = 0; i < vertices.size(); ++i) isBoundary[i] = mesh_.isBoundary(vertices[i]) ? 1 : 0;
  std::vector<int> count;
  for (std::size_t w = 0; w < ways.size(); ++w) {
    count = outside;
    count.push_back(ways[w].hasMiddle ? -4 : 0);
    for (const auto& cell : ways[w].cells) {
      for (const int i : cell) ++count[static_cast<std::size_t>(i)];
    }
    int energy = 0;
    for (std::size_t i = 0; i < count.size(); ++i) {
      energy += irregularity(isBoundary[i] != 0, count[i]);
    }
    if (energy == energyBefore && !isPoor) isPoor = worstOf(mesh_, cavity_.faces()) < kPoor;
    if (energy < energyBefore || (energy == energyBefore && *isPoor)) better.emplace_back(energy, w);
  }
  if (better.empty()) return false;
  std::sort(better.begin(), better.end());
  const double before = worstAround(mesh_, vertices);
  Vec3 centre;
  for (const VertexId v : vertices) centre += mesh_.position(v) / length;
  constexpr std::size_t kMaxTries = 4;
  for (std::size_t i = 0; i < std::min(better.size(), kMaxTries); ++i) {
    const LoopFilling& way = ways[better[i].second];
    if (cavity_.doublesEdge(mesh_, *loop, way.cells)) continue;
    const std::size_t mark = mesh_.mark();
    const EditMesh::Vertex middle = projectVertex(target_, mesh_.vertex(vertices[0]), centre);
    mesh_.fill(*loop, cavity_.faces(), way.cells,
               way.hasMiddle ? std::vector{middle} : std::vector<EditMesh::Vertex>{});
    const bool sameEnergy = better[i].first == energyBefore;
    if (settle(vertices, sameEnergy ? before + kWorthwhile : std::min(options_.leastShape, before), mark)) {
      ++statistics_.refills;
      return true;
    }
  }
  return false;
}

bool TopologicalCleanup::refillAround(VertexId v) {
  if (!mesh_.alive(v) || excess(v) == 0) return false;
  // The fan of an inner vertex, then each pair and triple of neighbouring quads of the vertex.
  std::vector<FaceId> fan;
  std::vector<HalfedgeId> spokes;
  mesh_.forEachOutgoing(v, [&](HalfedgeId h) {
    fan.push_back(mesh_.face(h));
    spokes.push_back(h);
  });
  const auto refillFaces = [this](const std::vector<FaceId>& faces) {
    cavity_.clear();
    for (const FaceId f : faces) cavity_.add(f);
    return refill();
  };
  const bool closed = !mesh_.isBoundary(v);
  if (closed && fan.size() <= 5 && refillFaces(fan)) return true;
  for (std::size_t width : {std::size_t{2}, std::size_t{3}}) {
    if (fan.size() < width) break;
    for (std::size_t i = 0; i < fan.size(); ++i) {
      if (!closed && i + width > fan.size()) break;
      cavity_.clear();
      for (std::size_t k = 0; k < width; ++k) cavity_.add(fan[(i + k) % fan.size()]);
      if (refill()) return true;
    }
  }
  // The fans of two irregular neighbours together.
  for (std::size_t i = 0; closed && i < fan.size(); ++i) {
    const VertexId other = mesh_.target(spokes[i]);
    if (mesh_.isBoundary(other) || excess(other) == 0) continue;
    std::vector<FaceId> both = fan;
    mesh_.forEachOutgoing(other, [&](HalfedgeId h) { both.push_back(mesh_.face(h)); });
    if (refillFaces(both)) return true;
  }
  // Each quad of the vertex with its neighbours on the far side.
  for (const FaceId f : fan) {
    for (const HalfedgeId h : mesh_.sides(f)) {
      if (!h.valid() || !mesh_.twin(h).valid()) continue;
      const FaceId other = mesh_.face(mesh_.twin(h));
      if (std::find(fan.begin(), fan.end(), other) != fan.end()) continue;
      if (refillFaces({f, other})) return true;
    }
  }
  return false;
}

bool TopologicalCleanup::bridgeTriangles(FaceId from, std::size_t quads) {
  path_.push_back(from);
  bool changed = false;
  for (const HalfedgeId h : mesh_.sides(from)) {
    if (changed || !h.valid() || !mesh_.twin(h).valid()) continue;
    const FaceId next = mesh_.face(mesh_.twin(h));
    if (std::find(path_.begin(), path_.end(), next) != path_.end()) continue;
    const bool isTriangle = mesh_.cornerCount(next) == 3;
    if (isTriangle && quads == 0) {
      cavity_.clear();
      for (const FaceId f : path_) cavity_.add(f);
      cavity_.add(next);
      changed = refill();
    } else if (!isTriangle && quads > 0) {
      changed = bridgeTriangles(next, quads - 1);
    }
  }
  path_.pop_back();
  return changed;
}

std::int64_t TopologicalCleanup::bridgeAllTriangles() {
  std::int64_t changes = 0;
  const auto [elements, triangles] = countElements(mesh_);
  const bool areFew = triangles <= kFewTriangles || kElementsPerTriangle * triangles <= elements;
  const std::size_t longest = areFew ? kLongestBridge : 0;
  for (std::size_t quads = 0; quads <= longest; ++quads) {
    for (std::size_t i = 0; i < mesh_.faceCapacity(); ++i) {
      const FaceId f(i);
      if (mesh_.kind(f) == FaceKind::removed || mesh_.cornerCount(f) != 3) continue;
      changes += bridgeTriangles(f, quads) ? 1 : 0;
    }
  }
  return changes;
}

std::int64_t TopologicalCleanup::pass() {
  std::int64_t changes = 0;
  note(TraceKind::doublet);
  for (std::size_t i = 0; i < mesh_.vertexCapacity(); ++i) changes += removeDoublet(VertexId(i)) ? 1 : 0;
  note(TraceKind::pair);
  for (std::size_t i = 0; i < mesh_.halfedgeCapacity(); ++i) changes += pairTriangles(HalfedgeId(i)) ? 1 : 0;
  changes += bridgeAllTriangles();
  note(TraceKind::collapse);
  for (std::size_t i = 0; i < mesh_.halfedgeCapacity(); ++i) changes += collapseDiagonal(HalfedgeId(i)) ? 1 : 0;
  note(TraceKind::refill);
  for (std::size_t i = 0; i < mesh_.vertexCapacity(); ++i) changes += refillAround(VertexId(i)) ? 1 : 0;
  return changes;
}

std::int64_t TopologicalCleanup::cavityPass() {
  std::int64_t changes = 0;
  note(TraceKind::cavity);
  for (std::size_t i = 0; i < mesh_.vertexCapacity(); ++i) changes += remeshCavity(VertexId(i)) ? 1 : 0;
  return changes;
}

}  // namespace qmcf
