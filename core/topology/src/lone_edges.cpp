// A sheet that meets a non-manifold edge in its middle, and no cut edge beside it, would have to be cut open along that
// single mesh edge. A slit needs at least two edges, so the edge is halved.

#include "edit_soup.hpp"
#include "repair_state.hpp"
#include "triangle_edges.hpp"

namespace qmcf::detail {

void splitLoneEdges(RepairState& state) {
  std::vector<std::array<VertexId, 2>> lone;
  {
    const TriangleEdges edges(state.mesh.triangles, state.mesh.positions.size());
    IdMap<EdgeId, std::uint8_t> cut(edges.edgeCount(), 0);
    for (const EdgeId e : edges.edges()) cut[e] = edges.isManifold(e) ? 0 : 1;
    const Fans fans = buildFans(edges, cut);
    for (const EdgeId e : edges.edges()) {
      if (cut[e] == 0) continue;
      for (const HalfedgeId h : edges.uses(e)) {
        const HalfedgeId g = nextCut(fans, h);
        if (g == h || edges.edge(g) != e || nextCut(fans, g) != h) continue;
        lone.push_back(edges.ends(e));
        break;
      }
    }
  }
  if (lone.empty()) return;
  RepairItem item{"loneNonManifoldEdges", "halved, so that the sheet can be cut there", 0, {}};
  EditSoup soup(state);
  for (const auto& [a, b] : lone) {
    note(item, state.origin[static_cast<std::size_t>(soup.trianglesAt(a.value, b.value).front())]);
    const Vec3 middle = (state.mesh.positions[a.index()] + state.mesh.positions[b.index()]) * 0.5;
    soup.splitEdge(a.value, b.value, soup.addVertex(middle));
  }
  soup.finish();
  addItem(state, std::move(item));
}

}  // namespace qmcf::detail
