#include <string>

#include "repair_state.hpp"
#include "triangle_edges.hpp"

namespace qmcf::detail {

void noteNonManifold(RepairState& state) {
  RepairItem items[] = {
      {"nonManifoldEdges", "kept: the sheets that meet there share its nodes", 0, {}},
      {"nonManifoldVertices", "kept: the sheets that meet there are separate", 0, {}},
  };
  const TriangleEdges edges(state.mesh.triangles, state.mesh.positions.size());
  IdMap<EdgeId, std::uint8_t> cut(edges.edgeCount(), 0);
  IdMap<VertexId, std::uint8_t> onCut(edges.vertexCount(), 0);
  for (const EdgeId e : edges.edges()) {
    const auto uses = edges.uses(e);
    if (edges.isManifold(e)) continue;
    cut[e] = 1;
    if (uses.size() == 1) continue;
    for (const VertexId v : edges.ends(e)) onCut[v] = 1;
    if (uses.size() > 2) note(items[0], state.origin[Surface::triangle(uses[0]).index()]);
  }
  // Several fans at a vertex that no such edge explains: sheets touch in a point.
  const Fans fans = buildFans(edges, cut);
  IdMap<VertexId, std::int32_t> count(edges.vertexCount(), 0);
  for (const HalfedgeId h : fans.first) {
    const VertexId v = edges.origin(h);
    if (++count[v] == 2 && onCut[v] == 0) note(items[1], v.value);
  }
  for (RepairItem& item : items) addItem(state, std::move(item));
}

}  // namespace qmcf::detail
