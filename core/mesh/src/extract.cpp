#include "qmcf/mesh/extract.hpp"

#include <cstddef>

namespace qmcf {

FaceMesh extract(const EditMesh& mesh, const std::vector<std::int32_t>& patchVertex) {
  FaceMesh result;
  IdMap<VertexId, std::int32_t> index(mesh.vertexCapacity(), kNone);
  for (std::size_t i = 0; i < mesh.vertexCapacity(); ++i) {
    const VertexId v(i);
    if (!mesh.alive(v)) continue;
    index[v] = static_cast<std::int32_t>(result.positions.size());
    result.positions.push_back(mesh.position(v));
    result.normals.push_back(mesh.normal(v));
    result.locations.push_back(mesh.vertex(v).location);
    result.patchVertex.push_back(i < patchVertex.size() ? patchVertex[i] : kNone);
  }
  for (std::size_t i = 0; i < mesh.faceCapacity(); ++i) {
    const FaceId f(i);
    if (mesh.kind(f) == FaceKind::removed) continue;
    Element element{kNone, kNone, kNone, kNone};
    const auto sides = mesh.sides(f);
    for (std::size_t c = 0; c < 4; ++c) {
      if (sides[c].valid()) element[c] = index[mesh.origin(sides[c])];
    }
    result.elements.push_back(element);
  }
  return result;
}

}  // namespace qmcf
