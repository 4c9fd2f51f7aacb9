// Transitions between front edges of different length: Owen et al. 1999 (C6 of docs/algorithm.md).
#include "transition.hpp"

#include <algorithm>

#include "qmcf/front/quad_formation.hpp"
#include "qmcf/front/recovery.hpp"
#include "qmcf/mesh/element_shape.hpp"

namespace qmcf {
namespace {

/// Halves of shorter edges, in element sizes, would only call for further transitions, without end.
constexpr double kShortestHalved = 0.8;

/// The longer of two front edges that meet in the apex, and the quad behind it, as it lies seen from the apex.
struct LongEdge {
  HalfedgeId edge;  ///< The front edge.
  VertexId apex;
  VertexId end;        ///< Its other node.
  VertexId beyond;     ///< Corner of the quad next to the end.
  VertexId behind;     ///< Corner of the quad next to the apex.
  bool leaves = true;  ///< The front edge runs from the apex, rather than to it.
};

/// Invalid edge when there is no quad behind it or it is not long.
LongEdge longerAt(const MorphMesh& morph, HalfedgeId h) {
  const EditMesh& mesh = morph.mesh();
  const HalfedgeId previous = morph.front().previousFront(h);
  LongEdge found;
  found.apex = mesh.origin(h);
  found.leaves = morph.length(h) >= morph.length(previous);
  const HalfedgeId edge = found.leaves ? h : previous;
  if (morph.length(edge) < kShortestHalved * morph.front().sizeAt(mesh.vertex(found.apex).location)) return found;
  const HalfedgeId t = mesh.twin(edge);
  if (!t.valid() || mesh.cornerCount(mesh.face(t)) != 4) return found;
  found.edge = edge;
  found.end = found.leaves ? mesh.target(edge) : mesh.origin(edge);
  const VertexId afterTwin = mesh.target(mesh.next(t));  // t runs end -> apex if the edge leaves the apex
  const VertexId beforeTwin = mesh.origin(mesh.prev(t));
  found.behind = found.leaves ? afterTwin : beforeTwin;
  found.beyond = found.leaves ? beforeTwin : afterTwin;
  return found;
}

/// Opens the quad behind the long edge as two triangles with a diagonal from `from` to `to`. Returns the diagonal.
HalfedgeId openQuad(EditMesh& mesh, const LongEdge& edge, VertexId from, VertexId to) {
  const FaceId f = mesh.face(mesh.twin(edge.edge));
  HalfedgeId first;
  HalfedgeId second;
  for (const HalfedgeId side : mesh.sides(f)) {
    if (mesh.origin(side) == from) first = side;
    if (mesh.origin(side) == to) second = side;
  }
  const HalfedgeId diagonal = mesh.cut(first, second);
  mesh.setKind(mesh.face(diagonal), FaceKind::open);
  mesh.setKind(mesh.face(mesh.twin(diagonal)), FaceKind::open);
  return diagonal;
}

/// Corners of a quad in the order that is counter-clockwise.
std::vector<VertexId> oriented(const LongEdge& edge, std::vector<VertexId> corners) {
  // As given they are so where the front edge leaves the apex.
  if (!edge.leaves) std::reverse(corners.begin(), corners.end());
  return corners;
}

double worstAt(const EditMesh& mesh, const std::vector<VertexId>& vertices) {
  double worst = 1.0;
  for (const VertexId v : vertices) worst = std::min(worst, worstShapeAround(mesh, v));
  return worst;
}

EditMesh::Vertex between(const MorphMesh& morph, VertexId a, VertexId b) {
  const EditMesh& mesh = morph.mesh();
  return morph.place(mesh.vertex(a), (mesh.position(a) + mesh.position(b)) * 0.5);
}

}  // namespace

std::vector<VertexId> transitionSeam(MorphMesh& morph, HalfedgeId h, double least) {
  EditMesh& mesh = morph.mesh();
  const LongEdge edge = longerAt(morph, h);
  if (!edge.edge.valid() || mesh.connected(edge.end, edge.behind)) return {};
  const VertexId shortEnd = edge.leaves ? mesh.origin(morph.front().previousFront(h)) : mesh.target(h);
  const std::size_t mark = mesh.mark();
  openQuad(mesh, edge, edge.end, edge.behind);
  const VertexId middle = mesh.splitEdge(edge.edge, between(morph, edge.apex, edge.end));
  if (formElement(morph.front(), oriented(edge, {edge.end, middle, edge.behind, edge.beyond}), least)) {
    // The side of the new quad that runs from its middle to the short edge's end.
    const HalfedgeId start = mesh.find(middle, edge.leaves ? edge.end : edge.behind);
    const bool joined = mesh.connected(middle, shortEnd) ||
                        (start.valid() && mesh.isOpen(start) && recoverEdge(morph.front(), start, shortEnd).valid());
    std::vector<VertexId> corners = oriented(edge, {middle, shortEnd, edge.apex, edge.behind});
    if (joined && formElement(morph.front(), corners, least) && worstAt(mesh, {middle}) > 0.0) return corners;
  }
  mesh.rollback(mark);
  return {};
}

HalfedgeId transitionSplit(MorphMesh& morph, HalfedgeId h, double least) {
  EditMesh& mesh = morph.mesh();
  const LongEdge edge = longerAt(morph, h);
  if (!edge.edge.valid() || mesh.connected(edge.apex, edge.beyond)) return {};
  const std::size_t mark = mesh.mark();
  const HalfedgeId diagonal = openQuad(mesh, edge, edge.apex, edge.beyond);
  const Vec3 sum =
      mesh.position(edge.apex) + mesh.position(edge.end) + mesh.position(edge.beyond) + mesh.position(edge.behind);
  const VertexId centre = mesh.splitEdge(diagonal, morph.place(mesh.vertex(edge.apex), sum / 4.0));
  const VertexId middle = mesh.splitEdge(edge.edge, between(morph, edge.apex, edge.end));
  if (formElement(morph.front(), oriented(edge, {edge.end, middle, centre, edge.beyond}), least) &&
      formElement(morph.front(), oriented(edge, {edge.apex, edge.behind, edge.beyond, centre}), least) &&
      worstAt(mesh, {middle, centre}) > 0.0) {
    return edge.leaves ? mesh.find(edge.apex, centre) : mesh.find(centre, edge.apex);
  }
  mesh.rollback(mark);
  return {};
}

}  // namespace qmcf
