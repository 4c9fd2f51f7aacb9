// Relaxation by shape matching: every element asks for the regular polygon that fits it best.
#include "relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/spatial/surface_walk.hpp"

namespace qmcf {
namespace {

/// Weight of the size field against the element's own size.
constexpr double kSizeWeight = 0.3;
/// Shorter moves, in element sizes, wake nobody.
constexpr double kStill = 1e-2;
/// Going further than wanted gets everything there in fewer sweeps, as in successive over-relaxation.
constexpr double kOverRelaxation = 1.4;

}  // namespace

Vec3 idealCorner(const EditMesh& mesh, HalfedgeId h, const Vec3& normal, double size) {
  const auto corner = [&mesh](HalfedgeId e) -> const Vec3& { return mesh.position(mesh.origin(e)); };
  const HalfedgeId second = mesh.next(h);
  const HalfedgeId third = mesh.next(second);
  const HalfedgeId last = mesh.prev(h);
  const Vec3& p0 = corner(h);
  const Vec3& p1 = corner(second);
  const Vec3& p2 = corner(third);
  // Corner i of the polygon, turned back by i steps about the centre, is an estimate of corner 0; their mean is the
  // least-squares fit. Of the turns little is left: the centre cancels, and so do the halves of opposite corners.
  Vec3 centre;
  Vec3 arm;
  double wanted = size;
  if (third == last) {
    constexpr double kSine = 0.8660254037844386;
    centre = (p0 + p1 + p2) / 3.0;
    arm = (tangentPart(p0 - (p1 + p2) * 0.5, normal) + cross(p1 - p2, normal) * kSine) / 3.0;
    wanted *= 0.6;
  } else {
    const Vec3& p3 = corner(last);
    centre = (p0 + p1 + p2 + p3) * 0.25;
    arm = (tangentPart(p0 - p2, normal) + cross(p1 - p3, normal)) * 0.25;
    wanted *= 0.7071067811865476;
  }
  const double length = norm(arm);
  if (!(length > 0.0)) return centre;
  return centre + arm * ((1.0 - kSizeWeight) + kSizeWeight * wanted / length);
}

double wantedSize(const RelaxationTarget& target, const EditMesh::Vertex& vertex) {
  return target.sizeScale * interpolate(target.patch.surface, target.patch.size, vertex.location);
}

EditMesh::Vertex projectVertex(const RelaxationTarget& target, const EditMesh::Vertex& from, const Vec3& position) {
  constexpr double kMinCosine = 0.3;
  EditMesh::Vertex vertex;
  if (target.onPatch) {
    vertex.location = walkToClosest(target.patch.surface, from.location.triangle, position);
    vertex.position = positionOf(target.patch.surface, vertex.location);
    vertex.facet = from.facet;
    vertex.normal = normalized(interpolate(target.patch.surface, target.patch.normal, vertex.location));
    return vertex;
  }
  const ClosestPoint closest = target.face.closest(position, from.normal, kMinCosine, from.facet);
  vertex.position = closest.position;
  vertex.facet = closest.triangle;
  vertex.location = walkToClosest(target.patch.surface, from.location.triangle, vertex.position);
  vertex.normal = normalized(interpolate(target.patch.surface, target.patch.normal, vertex.location));
  return vertex;
}

namespace {

/// Moves a vertex to where its elements want it unless that makes one of them worse, see relax(). Returns how far, in
/// element sizes.
double relaxVertex(EditMesh& mesh, VertexId v, const RelaxationTarget& target, double enough) {
  const EditMesh::Vertex& vertex = mesh.vertex(v);
  const double size = wantedSize(target, vertex);
  Vec3 sum;
  int count = 0;
  mesh.forEachOutgoing(v, [&](HalfedgeId h) {
    sum += idealCorner(mesh, h, vertex.normal, size);
    ++count;
  });
  const Vec3 step = (sum / count - vertex.position) * kOverRelaxation;
  const EditMesh::Vertex moved = projectVertex(target, vertex, vertex.position + step);
  const double move = distance(moved.position, vertex.position) / size;
  const std::size_t mark = mesh.mark();
  mesh.setVertex(v, moved);
  if (isWellShapedAround(mesh, v, enough)) return move;
  const double after = worstShapeAround(mesh, v);
  const double squareAfter = worstSquareAround(mesh, v);
  mesh.rollback(mark);
  // An element that leans counts as bad whatever its shape, and by itself would let any shape around it pass.
  if (!(after >= worstShapeAround(mesh, v)) || !(squareAfter >= worstSquareAround(mesh, v))) return 0.0;
  mesh.setVertex(v, moved);
  return move;
}

}  // namespace

void relax(EditMesh& mesh, const std::vector<VertexId>& vertices, const RelaxationTarget& target, double enough) {
  for (const VertexId v : vertices) {
    if (mesh.alive(v) && !mesh.isBoundary(v)) (void)relaxVertex(mesh, v, target, enough);
  }
}

LazyRelaxation::LazyRelaxation(EditMesh& mesh, const RelaxationTarget& target, double enough, bool isAwake)
    : mesh_(mesh), target_(target), enough_(enough), awake_(mesh.vertexCapacity(), isAwake ? 1 : 0) {}

void LazyRelaxation::land() {
  target_.onPatch = false;
  awake_ = IdMap<VertexId, char>(mesh_.vertexCapacity(), 1);
}

void LazyRelaxation::wake(const std::vector<VertexId>& vertices) {
  awake_.resize(mesh_.vertexCapacity(), 1);
  for (const VertexId v : vertices) awake_[v] = 1;
}

bool LazyRelaxation::sweep() {
  bool isStill = true;
  for (const VertexId v : IdRange<VertexId>(awake_.size())) {
    if (awake_[v] == 0) continue;
    awake_[v] = 0;
    if (!mesh_.alive(v) || mesh_.isBoundary(v) || (!stays_.empty() && stays_[v] != 0)) continue;
    const double move = relaxVertex(mesh_, v, target_, enough_);
    mesh_.commitUnwatched();
    if (move <= kStill) continue;
    isStill = false;
    mesh_.forEachOutgoing(v, [&](HalfedgeId h) {
      for (HalfedgeId e = mesh_.next(h); e != h; e = mesh_.next(e)) awake_[mesh_.origin(e)] = 1;
    });
    awake_[v] = 1;
  }
  return !isStill;
}

}  // namespace qmcf
