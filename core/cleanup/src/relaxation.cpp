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

}  // namespace

Vec3 idealCorner(const EditMesh& mesh, HalfedgeId h, const Vec3& normal, double size) {
  const bool quad = mesh.cornerCount(mesh.face(h)) == 4;
  const int count = quad ? 4 : 3;
  std::array<Vec3, 4> p;
  Vec3 centre;
  HalfedgeId e = h;
  for (int i = 0; i < count; ++i, e = mesh.next(e)) {
    p[static_cast<std::size_t>(i)] = mesh.position(mesh.origin(e));
    centre += p[static_cast<std::size_t>(i)] / count;
  }
  // Corner i of the polygon, turned back by i steps, is an estimate of corner 0; their mean is the least-squares fit.
  const double c = quad ? 0.0 : -0.5;
  const double s = quad ? 1.0 : 0.8660254037844386;
  Vec3 sum;
  double cosine = 1.0;
  double sine = 0.0;
  for (int i = 0; i < count; ++i) {
    const Vec3 arm = tangentPart(p[static_cast<std::size_t>(i)] - centre, normal);
    sum += arm * cosine + cross(arm, normal) * sine;  // turned by -i steps about the normal
    const double next = cosine * c - sine * s;
    sine = sine * c + cosine * s;
    cosine = next;
  }
  const Vec3 arm = sum / count;
  const double length = norm(arm);
  if (!(length > 0.0)) return centre;
  const double wanted = size * (quad ? 0.7071067811865476 : 0.6);
  return centre + arm * ((1.0 - kSizeWeight) + kSizeWeight * wanted / length);
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

double relax(EditMesh& mesh, const std::vector<VertexId>& vertices, const RelaxationTarget& target, double enough) {
  double largest = 0.0;
  for (const VertexId v : vertices) {
    if (!mesh.alive(v) || mesh.isBoundary(v)) continue;
    const EditMesh::Vertex& vertex = mesh.vertex(v);
    const double size = target.sizeScale * interpolate(target.patch.surface, target.patch.size, vertex.location);
    Vec3 sum;
    int count = 0;
    mesh.forEachOutgoing(v, [&](HalfedgeId h) {
      sum += idealCorner(mesh, h, vertex.normal, size);
      ++count;
    });
    const EditMesh::Vertex moved = projectVertex(target, vertex, sum / count);
    const double move = distance(moved.position, vertex.position) / size;
    const std::size_t mark = mesh.mark();
    mesh.setVertex(v, moved);
    const double after = worstShapeAround(mesh, v);
    if (!(after >= enough)) {
      mesh.rollback(mark);
      if (!(after >= worstShapeAround(mesh, v))) continue;
      mesh.setVertex(v, moved);
    }
    largest = std::max(largest, move);
  }
  return largest;
}

}  // namespace qmcf
