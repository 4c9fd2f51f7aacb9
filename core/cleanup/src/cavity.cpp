#include "cavity.hpp"

#include <algorithm>
#include <cstddef>

#include "qmcf/mesh/element_shape.hpp"

namespace qmcf {

std::optional<std::vector<HalfedgeId>> Cavity::boundaryLoop(const EditMesh& mesh) {
  const auto isBorder = [&](HalfedgeId h) {
    const HalfedgeId t = mesh.twin(h);
    return !t.valid() || !contains(mesh.face(t));
  };
  std::size_t borders = 0;
  HalfedgeId first;
  for (const FaceId f : faces_) {
    for (const HalfedgeId h : mesh.sides(f)) {
      if (!h.valid() || !isBorder(h)) continue;
      ++borders;
      if (!first.valid()) first = h;
    }
  }
  if (!first.valid()) return std::nullopt;
  std::vector<HalfedgeId> loop;
  loop.reserve(borders);
  onLoop_.clear();
  HalfedgeId h = first;
  do {
    loop.push_back(h);
    if (!onLoop_.insert(mesh.origin(h))) return std::nullopt;
    h = mesh.next(h);
    while (!isBorder(h)) h = mesh.next(mesh.twin(h));
  } while (h != first);
  if (loop.size() != borders || !isDisc(mesh, borders)) return std::nullopt;
  return loop;
}

bool Cavity::isDisc(const EditMesh& mesh, std::size_t borders) {
  std::size_t corners = 0;
  std::size_t vertices = 0;
  met_.clear();
  for (const FaceId f : faces_) {
    for (const HalfedgeId h : mesh.sides(f)) {
      if (!h.valid()) continue;
      ++corners;
      if (met_.insert(mesh.origin(h))) ++vertices;
    }
  }
  const std::size_t edges = (corners + borders) / 2;
  return vertices + faces_.size() == edges + 1;
}

bool Cavity::doublesEdge(const EditMesh& mesh, const std::vector<HalfedgeId>& loop,
                         const std::vector<std::array<int, 4>>& cells) const {
  const auto count = static_cast<int>(loop.size());
  const auto isOutside = [&](HalfedgeId h) { return h.valid() && !contains(mesh.face(h)); };
  for (const auto& cell : cells) {
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const int from = cell[i];
      const int to = cell[(i + 1) % cell.size()];
      // Edges to new vertices and along the loop are as they should be; of the others each is met from both sides.
      if (from >= to || to >= count || to - from == 1 || to - from == count - 1) continue;
      const VertexId a = mesh.origin(loop[static_cast<std::size_t>(from)]);
      const VertexId b = mesh.origin(loop[static_cast<std::size_t>(to)]);
      if (isOutside(mesh.find(a, b)) || isOutside(mesh.find(b, a))) return true;
    }
  }
  return false;
}

const std::vector<VertexId>& Cavity::vertices(const EditMesh& mesh) {
  met_.clear();
  vertices_.clear();
  for (const FaceId f : faces_) {
    for (const HalfedgeId h : mesh.sides(f)) {
      if (h.valid() && met_.insert(mesh.origin(h))) vertices_.push_back(mesh.origin(h));
    }
  }
  return vertices_;
}

int Cavity::countAround(const EditMesh& mesh, VertexId v) const {
  int count = 0;
  mesh.forEachOutgoing(v, [&](HalfedgeId h) { count += contains(mesh.face(h)) ? 1 : 0; });
  return count;
}

std::vector<VertexId> cornersOf(const EditMesh& mesh, const std::vector<FaceId>& faces) {
  std::vector<VertexId> corners;
  for (const FaceId f : faces) {
    for (const HalfedgeId h : mesh.sides(f)) {
      if (h.valid()) corners.push_back(mesh.origin(h));
    }
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::vector<FaceId> facesAround(const EditMesh& mesh, const std::vector<VertexId>& vertices) {
  std::vector<FaceId> faces;
  for (const VertexId v : vertices) {
    if (!mesh.alive(v)) continue;
    mesh.forEachOutgoing(v, [&](HalfedgeId h) { faces.push_back(mesh.face(h)); });
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

int irregularity(bool boundary, int excess) {
  constexpr int kReflex = 4;
  return boundary && excess < 0 ? kReflex * excess * excess : excess * excess;
}

std::size_t triangleCount(const EditMesh& mesh, const std::vector<FaceId>& faces) {
  return static_cast<std::size_t>(
      std::count_if(faces.begin(), faces.end(), [&](FaceId f) { return mesh.cornerCount(f) == 3; }));
}

bool allQuads(const EditMesh& mesh, const std::vector<FaceId>& faces) {
  return std::all_of(faces.begin(), faces.end(), [&](FaceId f) { return mesh.cornerCount(f) == 4; });
}

double worstOf(const EditMesh& mesh, const std::vector<FaceId>& faces) {
  double worst = 1.0;
  for (const FaceId f : faces) worst = std::min(worst, faceShape(mesh, f));
  return worst;
}

}  // namespace qmcf
