#include "untangle.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "mend_quads.hpp"
#include "stand.hpp"

namespace qmcf {
namespace {

constexpr int kSweeps = 12;
/// From this sweep on the neighbours of the elements move too.
constexpr int kWiderSweep = 3;
/// Where more quads than a few and one of so many elements are turned over, they are too large for the face, and
/// smaller ones are a better remedy than other connections, which take long to find.
constexpr std::int64_t kFewQuads = 24;
constexpr std::int64_t kElementsPerMended = 100;
constexpr int kStraightenSweeps = 4;

/// The ways to change the two triangles beside an edge. Each returns whether it could be done.
bool join(EditMesh& mesh, HalfedgeId h) { return joinTriangles(mesh, h).valid(); }

bool turnDiagonal(EditMesh& mesh, HalfedgeId h) {
  const HalfedgeId t = mesh.twin(h);
  const HalfedgeId from = mesh.prev(h);
  const HalfedgeId to = mesh.prev(t);
  if (mesh.connected(mesh.origin(from), mesh.origin(to))) return false;
  joinTriangles(mesh, h);
  mesh.cut(from, to);
  return true;
}

bool contractEdge(EditMesh& mesh, HalfedgeId h) {
  if (mesh.isBoundary(mesh.target(h)) || !mesh.canCollapse(h)) return false;
  mesh.collapse(h);
  return true;
}

bool contractTwin(EditMesh& mesh, HalfedgeId h) { return contractEdge(mesh, mesh.twin(h)); }

/// Changes the two triangles beside h in the way that turns most elements back. Returns whether one does.
bool mendPair(EditMesh& mesh, const RelaxationTarget& target, HalfedgeId h) {
  using Change = bool (*)(EditMesh&, HalfedgeId);
  constexpr std::array<Change, 4> kChanges{turnDiagonal, join, contractEdge, contractTwin};
  const HalfedgeId t = mesh.twin(h);
  const std::vector<VertexId> around{mesh.origin(h), mesh.target(h), mesh.origin(mesh.prev(h)),
                                     mesh.origin(mesh.prev(t))};
  Damage least = damageAround(mesh, target, around);
  const int before = least.turnedOver;
  Change best = nullptr;
  for (const Change change : kChanges) {
    const std::size_t mark = mesh.mark();
    if (change(mesh, h)) {
      const Damage damage = damageAround(mesh, target, around);
      if (damage.turnedOver < before && damage < least) {
        least = damage;
        best = change;
      }
    }
    mesh.rollback(mark);
  }
  return best != nullptr && best(mesh, h);
}

/// Where moving vertices has not helped, pairs of triangles are changed.
bool mendTriangles(EditMesh& mesh, const RelaxationTarget& target) {
  bool helped = false;
  for (std::size_t i = 0; i < mesh.faceCapacity(); ++i) {
    const FaceId f(i);
    if (mesh.kind(f) == FaceKind::removed || mesh.cornerCount(f) != 3 || !standOf(mesh, target, f).turnedOver) continue;
    for (const HalfedgeId h : mesh.sides(f)) {
      if (!h.valid() || !mesh.twin(h).valid() || mesh.cornerCount(mesh.face(mesh.twin(h))) != 3) continue;
      if (!mendPair(mesh, target, h)) continue;
      helped = true;
      break;
    }
  }
  mesh.commit();
  return helped;
}

/// Moves the vertices of elements that stand badly, though they are not turned over, where no more are for it.
void straighten(EditMesh& mesh, const RelaxationTarget& target) {
  for (int sweep = 0; sweep < kStraightenSweeps; ++sweep) {
    std::vector<VertexId> vertices;
    for (std::size_t i = 0; i < mesh.faceCapacity(); ++i) {
      const FaceId f(i);
      if (mesh.kind(f) == FaceKind::removed || !(standOf(mesh, target, f).penalty > 0.0)) continue;
      for (const HalfedgeId h : mesh.sides(f)) {
        if (h.valid() && !mesh.isBoundary(mesh.origin(h))) vertices.push_back(mesh.origin(h));
      }
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    bool helped = false;
    for (const VertexId v : vertices) {
      const std::size_t mark = mesh.mark();
      const int before = damageAround(mesh, target, {v}).turnedOver;
      if (!moveToBest(mesh, target, v)) continue;
      const bool isWorse = damageAround(mesh, target, {v}).turnedOver > before;
      if (isWorse) mesh.rollback(mark);
      helped = helped || !isWorse;
    }
    mesh.commit();
    if (!helped) break;
  }
}

}  // namespace

FaceId joinTriangles(EditMesh& mesh, HalfedgeId h) {
  const HalfedgeId t = mesh.twin(h);
  return mesh.fill({mesh.next(h), mesh.prev(h), mesh.next(t), mesh.prev(t)}, {mesh.face(h), mesh.face(t)},
                   FaceKind::element);
}

std::int64_t untangle(EditMesh& mesh, const RelaxationTarget& target, bool quadsOnly) {
  std::int64_t found = 0;
  std::int64_t before = 0;  // Elements turned over, one sweep and two sweeps ago.
  std::int64_t earlier = 0;
  const bool mendsQuads = quadsOnly || target.part != nullptr;
  const std::int64_t mostMended = kFewQuads + static_cast<std::int64_t>(mesh.faceCapacity()) / kElementsPerMended;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    std::int64_t turnedOver = 0;
    std::vector<VertexId> vertices;  // Of these elements.
    for (std::size_t i = 0; i < mesh.faceCapacity(); ++i) {
      const FaceId f(i);
      if (mesh.kind(f) == FaceKind::removed || !standOf(mesh, target, f).turnedOver) continue;
      ++turnedOver;
      for (const HalfedgeId h : mesh.sides(f)) {
        if (!h.valid()) continue;
        vertices.push_back(mesh.origin(h));
        if (sweep < kWiderSweep) continue;
        mesh.forEachOutgoing(mesh.origin(h), [&](HalfedgeId out) { vertices.push_back(mesh.target(out)); });
      }
    }
    if (sweep == 0) found = turnedOver;
    // What two sweeps with all there is have not turned back will not be; changes of quads make way for others.
    if (vertices.empty() || (!quadsOnly && sweep > kWiderSweep + 1 && turnedOver >= earlier)) break;
    earlier = std::exchange(before, turnedOver);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    bool helped = false;
    for (const VertexId v : vertices) {
      if (!mesh.isBoundary(v)) helped = moveToBest(mesh, target, v) || helped;
    }
    mesh.commit();
    if (sweep < kWiderSweep) continue;
    if (!quadsOnly) helped = mendTriangles(mesh, target) || helped;
    if (mendsQuads && turnedOver <= mostMended) helped = mendQuads(mesh, target) || helped;
    if (!helped) break;
  }
  if (quadsOnly) straighten(mesh, target);
  return found;
}

}  // namespace qmcf
