#include "qmcf/front/extract.hpp"

namespace qmcf {

FaceMesh extract(const FrontMesh& front) {
  const EditMesh& mesh = front.mesh();
  FaceMesh result;
  IdMap<VertexId, std::int32_t> index(mesh.vertexCapacity(), kNone);
  for (std::size_t i = 0; i < mesh.vertexCapacity(); ++i) {
    const VertexId v(i);
    if (!mesh.alive(v)) continue;
    index[v] = static_cast<std::int32_t>(result.positions.size());
    result.positions.push_back(mesh.position(v));
    result.normals.push_back(mesh.normal(v));
    result.locations.push_back(mesh.vertex(v).location);
    result.patchVertex.push_back(mesh.isBoundary(v) ? v.value : kNone);
  }
  for (std::size_t i = 0; i < mesh.faceCapacity(); ++i) {
    const FaceId f(i);
    if (mesh.kind(f) == FaceKind::removed) continue;
    Element element{kNone, kNone, kNone, kNone};
    HalfedgeId h = mesh.halfedge(f);
    for (int c = 0; c < mesh.cornerCount(f); ++c, h = mesh.next(h))
      element[static_cast<std::size_t>(c)] = index[mesh.origin(h)];
    result.elements.push_back(element);
  }
  return result;
}

}  // namespace qmcf
