#include "shared_nodes.hpp"

#include "qmcf/sizing/edge_curve.hpp"

namespace qmcf {

SharedNodes sharedNodes(const DividedEdges& divided) { return {divided.nodes, divided.edges, {}}; }

SharedNodes halvedNodes(const TriangleMesh& mesh, const Brep& brep, const DividedEdges& divided) {
  SharedNodes shared;
  shared.positions = divided.nodes;
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const EdgeCurve curve = edgeCurve(mesh, brep.edges[e]);
    const EdgeDivision& whole = divided.edges[e];
    EdgeDivision halves{{whole.nodes.front()}, {whole.arcLength.front()}};
    shared.firstHalf.push_back(static_cast<std::int32_t>(shared.positions.size()));
    for (std::size_t i = 0; i + 1 < whole.nodes.size(); ++i) {
      const double middle = 0.5 * (whole.arcLength[i] + whole.arcLength[i + 1]);
      halves.nodes.push_back(static_cast<std::int32_t>(shared.positions.size()));
      halves.arcLength.push_back(middle);
      shared.positions.push_back(curve.at(middle));
      halves.nodes.push_back(whole.nodes[i + 1]);
      halves.arcLength.push_back(whole.arcLength[i + 1]);
    }
    shared.edges.push_back(std::move(halves));
  }
  return shared;
}

std::int32_t halvingNode(const Patch& patch, HalfedgeId h, const DividedEdges& divided, const SharedNodes& shared) {
  const auto edge = static_cast<std::size_t>(patch.edge[h]);
  const std::int32_t a = patch.node[patch.surface.origin(h)];
  const std::int32_t b = patch.node[patch.surface.target(h)];
  const auto& nodes = divided.edges[edge].nodes;
  std::size_t i = 0;
  while (i + 2 < nodes.size() && !(nodes[i] == a && nodes[i + 1] == b) && !(nodes[i] == b && nodes[i + 1] == a)) ++i;
  return shared.firstHalf[edge] + static_cast<std::int32_t>(i);
}

}  // namespace qmcf
