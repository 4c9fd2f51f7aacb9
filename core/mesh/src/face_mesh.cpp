#include "qmcf/mesh/face_mesh.hpp"

#include <algorithm>
#include <cstddef>

namespace qmcf {

FaceMesh trianglesOf(const Patch& patch) {
  FaceMesh mesh;
  const Surface& surface = patch.surface;
  for (const VertexId v : surface.vertices()) {
    const HalfedgeId h = surface.outgoing(v);
    SurfacePoint location{Surface::triangle(h), {0.0, 0.0, 0.0}};
    location.barycentric[static_cast<std::size_t>(h.value % 3)] = 1.0;
    mesh.positions.push_back(surface.position(v));
    mesh.normals.push_back(patch.normal[v]);
    mesh.locations.push_back(location);
    mesh.patchVertex.push_back(surface.isBoundary(v) ? v.value : kNone);
  }
  for (const TriangleId t : surface.triangles()) {
    const auto corners = surface.corners(t);
    mesh.elements.push_back({corners[0].value, corners[1].value, corners[2].value, kNone});
  }
  return mesh;
}

std::vector<std::array<std::int32_t, 2>> edgesOf(const FaceMesh& mesh) {
  std::vector<std::array<std::int32_t, 2>> edges;
  for (const Element& element : mesh.elements) {
    const std::size_t corners = cornerCount(element);
    for (std::size_t c = 0; c < corners; ++c) {
      const auto [first, last] = std::minmax(element[c], element[(c + 1) % corners]);
      edges.push_back({first, last});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace qmcf
