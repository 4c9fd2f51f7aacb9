#include "qmcf/front/extract.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "qmcf/mesh/extract.hpp"

namespace qmcf {

FaceMesh extract(const FrontMesh& front) {
  const EditMesh& mesh = front.mesh();
  // The working triangulation began as the patch: its boundary vertices have their ids still.
  std::vector<std::int32_t> patchVertex(mesh.vertexCapacity(), kNone);
  for (std::size_t i = 0; i < patchVertex.size(); ++i) {
    const VertexId v(i);
    if (mesh.alive(v) && mesh.isBoundary(v)) patchVertex[i] = v.value;
  }
  return extract(mesh, patchVertex);
}

}  // namespace qmcf
