#include "qmcf/front/seam.hpp"

#include <algorithm>
#include <utility>

#include "qmcf/front/quad_formation.hpp"
#include "qmcf/front/recovery.hpp"
#include "qmcf/mesh/element_shape.hpp"

namespace qmcf {
namespace {

/// Front edges that differ more in length need a transition, not a seam.
constexpr double kLargestRatio = 2.5;

}  // namespace

VertexId closeSeam(FrontMesh& front, HalfedgeId h, double least) {
  EditMesh& mesh = front.mesh();
  const HalfedgeId previous = front.previousFront(h);
  const VertexId apex = mesh.origin(h);
  const VertexId after = mesh.target(h);
  const VertexId before = mesh.origin(previous);
  if (after == before || (front.isFixed(after) && front.isFixed(before))) return {};
  const double lengthAfter = distance(mesh.position(apex), mesh.position(after));
  const double lengthBefore = distance(mesh.position(apex), mesh.position(before));
  if (lengthAfter > kLargestRatio * lengthBefore || lengthBefore > kLargestRatio * lengthAfter) return {};

  const std::size_t mark = mesh.mark();
  // The wedge as one open triangle (apex, after, before).
  const HalfedgeId closing = recoverEdge(front, front.nextFront(h), before);
  if (closing.valid()) {
    const std::vector<HalfedgeId> wedge{h, closing, previous};
    const auto region = enclosedRegion(front, wedge);
    if (region && !front.isFront(mesh.twin(closing))) {
      if (region->size() > 1) mesh.fill(wedge, *region, FaceKind::open);
      const bool keepBefore = front.isFixed(before);
      const HalfedgeId contracted = keepBefore ? mesh.twin(closing) : closing;
      const VertexId kept = keepBefore ? before : after;
      const Vec3 middle = (mesh.position(after) + mesh.position(before)) * 0.5;
      if (mesh.canCollapse(contracted)) {
        mesh.collapse(contracted);
        if (!front.isFixed(kept)) mesh.setVertex(kept, front.vertexNear(mesh.vertex(kept).location, middle));
        double worst = 1.0;
        mesh.forEachOutgoing(kept, [&](HalfedgeId out) { worst = std::min(worst, faceShape(mesh, mesh.face(out))); });
        if (worst >= least) return kept;
      }
    }
  }
  mesh.rollback(mark);
  return {};
}

VertexId closeDiamond(FrontMesh& front, const std::vector<VertexId>& corners, double least) {
  EditMesh& mesh = front.mesh();
  constexpr double kAnyShape = -10.0;
  const std::size_t mark = mesh.mark();
  for (std::size_t first = 0; first < 2; ++first) {
    const auto quad = formElement(front, corners, kAnyShape);
    if (!quad) return {};
    VertexId kept = corners[first];
    VertexId gone = corners[first + 2];
    if (front.isFixed(gone)) std::swap(kept, gone);
    HalfedgeId from;
    HalfedgeId to;
    for (const HalfedgeId side : mesh.sides(*quad)) {
      if (mesh.origin(side) == kept) from = side;
      if (mesh.origin(side) == gone) to = side;
    }
    const HalfedgeId diagonal = mesh.connected(kept, gone) ? HalfedgeId() : mesh.cut(from, to);
    if (diagonal.valid() && mesh.canCollapse(diagonal)) {
      const Vec3 middle = (mesh.position(kept) + mesh.position(gone)) * 0.5;
      mesh.collapse(diagonal);
      if (!front.isFixed(kept)) mesh.setVertex(kept, front.vertexNear(mesh.vertex(kept).location, middle));
      if (worstShapeAround(mesh, kept) >= least) return kept;
    }
    mesh.rollback(mark);
  }
  return {};
}

}  // namespace qmcf
