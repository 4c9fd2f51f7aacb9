#include <algorithm>

#include "qmcf/mesh/edit_mesh.hpp"

namespace qmcf {

EditMesh::Changes EditMesh::changes() const {
  Changes changes;
  std::size_t newFaces = 0;
  for (const Entry& entry : journal_) {
    const auto index = static_cast<std::size_t>(entry.index);
    if (entry.edit == Edit::vertex) changes.vertices.emplace_back(index);
    if (entry.edit == Edit::newFace) ++newFaces;
    if (entry.edit != Edit::word) continue;
    if (entry.array == kFaceHalfedge || entry.array == kFaceKind) changes.faces.emplace_back(index);
    if (entry.array > kFace || !alive(HalfedgeId(index)) || !face(HalfedgeId(index)).valid()) continue;
    changes.faces.push_back(face(HalfedgeId(index)));
  }
  for (std::size_t f = faceCapacity() - newFaces; f < faceCapacity(); ++f) changes.faces.emplace_back(f);
  const auto sortOnce = [](auto& ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  };
  sortOnce(changes.faces);
  sortOnce(changes.vertices);
  return changes;
}

}  // namespace qmcf
