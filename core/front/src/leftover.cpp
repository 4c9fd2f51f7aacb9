// What the front could not mesh: fewer triangles, then pairs of them as quads.
#include "qmcf/front/leftover.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "qmcf/front/recovery.hpp"
#include "qmcf/mesh/element_shape.hpp"

namespace qmcf {
namespace {

constexpr double kLeastPair = 0.25;

/// Quality of the quad that two triangles make.
double pairQuality(const FrontMesh& front, HalfedgeId h) {
  const EditMesh& mesh = front.mesh();
  const HalfedgeId t = mesh.twin(h);
  return quadShape(mesh, {mesh.origin(h), mesh.origin(mesh.prev(t)), mesh.origin(t), mesh.origin(mesh.prev(h))});
}

bool contractInto(FrontMesh& front, HalfedgeId h) {
  EditMesh& mesh = front.mesh();
  constexpr double kLeast = 0.1;
  if (!mesh.canCollapse(h)) return false;
  const VertexId kept = mesh.origin(h);
  const std::size_t mark = mesh.mark();
  mesh.collapse(h);
  double worst = 1.0;
  mesh.forEachOutgoing(kept, [&](HalfedgeId out) {
    if (mesh.isOpen(out)) worst = std::min(worst, faceShape(mesh, mesh.face(out)));
  });
  if (worst >= kLeast) return true;
  mesh.rollback(mark);
  return false;
}

}  // namespace

void removeFreeVertices(FrontMesh& front) {
  EditMesh& mesh = front.mesh();
  for (std::size_t i = 0; i < mesh.vertexCapacity(); ++i) {
    const VertexId v(i);
    if (!mesh.alive(v) || !front.isFree(v)) continue;
    std::vector<std::pair<double, HalfedgeId>> spokes;
    mesh.forEachOutgoing(v, [&](HalfedgeId h) {
      spokes.emplace_back(distance(mesh.position(v), mesh.position(mesh.target(h))), mesh.twin(h));
    });
    std::sort(spokes.begin(), spokes.end());
    for (const auto& [length, inward] : spokes) {
      const VertexId kept = mesh.origin(inward);
      if (contractInto(front, inward)) {
        makeDelaunay(front, {kept});
        break;
      }
    }
  }
}

std::int64_t pairTriangles(FrontMesh& front) {
  EditMesh& mesh = front.mesh();
  std::vector<std::tuple<double, HalfedgeId>> pairs;
  for (std::size_t i = 0; i < mesh.halfedgeCapacity(); ++i) {
    const HalfedgeId h(i);
    if (!mesh.alive(h) || !mesh.isOpen(h) || front.isFront(h) || mesh.twin(h) < h) continue;
    const double quality = pairQuality(front, h);
    if (quality >= kLeastPair) pairs.emplace_back(-quality, h);
  }
  std::sort(pairs.begin(), pairs.end());
  std::int64_t count = 0;
  for (const auto& [negativeQuality, h] : pairs) {
    if (!mesh.alive(h) || !mesh.isOpen(h) || front.isFront(h)) continue;
    const HalfedgeId t = mesh.twin(h);
    mesh.fill({mesh.next(h), mesh.prev(h), mesh.next(t), mesh.prev(t)}, {mesh.face(h), mesh.face(t)},
              FaceKind::element);
    ++count;
  }
  for (std::size_t i = 0; i < mesh.faceCapacity(); ++i) {
    if (mesh.kind(FaceId(i)) == FaceKind::open) mesh.setKind(FaceId(i), FaceKind::element);
  }
  return count;
}

}  // namespace qmcf
