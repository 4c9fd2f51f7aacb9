#include "bodies.hpp"

#include "qmcf/base/bounding_box.hpp"

namespace qmcf::detail {

Bodies findBodies(const TriangleMesh& mesh, const TriangleEdges& edges) {
  Bodies bodies;
  bodies.ofTriangle.assign(mesh.triangles.size(), kNone);
  for (const TriangleId root : edges.triangles()) {
    if (bodies.ofTriangle[root.index()] != kNone) continue;
    BoundingBox box;
    std::uint8_t closed = 1;
    flood(edges, root, nullptr, bodies.ofTriangle, static_cast<std::int32_t>(bodies.diagonal.size()),
          [&](TriangleId t) {
            for (int c = 0; c < 3; ++c) {
              const HalfedgeId h = Surface::halfedge(t, c);
              box.include(mesh.positions[edges.origin(h).index()]);
              if (edges.uses(edges.edge(h)).size() == 1) closed = 0;
            }
          });
    bodies.diagonal.push_back(box.diagonal());
    bodies.closed.push_back(closed);
  }
  return bodies;
}

}  // namespace qmcf::detail
