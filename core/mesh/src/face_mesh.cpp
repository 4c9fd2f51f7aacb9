#include "qmcf/mesh/face_mesh.hpp"

#include <algorithm>
#include <cstddef>

namespace qmcf {

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
