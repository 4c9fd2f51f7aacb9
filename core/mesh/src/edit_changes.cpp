#include <algorithm>

#include "qmcf/mesh/edit_mesh.hpp"

namespace qmcf {

EditMesh::Changes EditMesh::changes() const {
  Changes changes;
  forEachChange([&](FaceId f) { changes.faces.push_back(f); }, [&](VertexId v) { changes.vertices.push_back(v); });
  const auto sortOnce = [](auto& ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  };
  sortOnce(changes.faces);
  sortOnce(changes.vertices);
  return changes;
}

}  // namespace qmcf
