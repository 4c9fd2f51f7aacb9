#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/mesh/triangle_mesh.hpp"
#include "triangle_edges.hpp"

namespace qmcf::detail {

/// The connected components of a mesh: triangles connected through edges, by their first triangle.
struct Bodies {
  std::vector<std::int32_t> ofTriangle;
  std::vector<double> diagonal;      ///< Per body: of its bounding box.
  std::vector<std::uint8_t> closed;  ///< Per body: no edge has only one triangle.

  [[nodiscard]] std::size_t count() const { return diagonal.size(); }
  [[nodiscard]] std::size_t of(const TriangleEdges& edges, EdgeId e) const {
    return static_cast<std::size_t>(ofTriangle[Surface::triangle(edges.uses(e)[0]).index()]);
  }
};

Bodies findBodies(const TriangleMesh& mesh, const TriangleEdges& edges);

/// Sets label to value for all triangles reachable from root through edges with barrier[e] == 0 (all edges when there
/// is no barrier) and whose label is kNone. Calls visit for each.
template <class Visit>
void flood(const TriangleEdges& edges, TriangleId root, const IdMap<EdgeId, std::uint8_t>* barrier,
           std::vector<std::int32_t>& label, std::int32_t value, Visit visit) {
  std::vector<TriangleId> stack{root};
  label[root.index()] = value;
  while (!stack.empty()) {
    const TriangleId t = stack.back();
    stack.pop_back();
    visit(t);
    for (int c = 0; c < 3; ++c) {
      const EdgeId e = edges.edge(Surface::halfedge(t, c));
      if (barrier != nullptr && (*barrier)[e] != 0) continue;
      for (const HalfedgeId g : edges.uses(e)) {
        const TriangleId u = Surface::triangle(g);
        if (label[u.index()] != kNone) continue;
        label[u.index()] = value;
        stack.push_back(u);
      }
    }
  }
}

}  // namespace qmcf::detail
