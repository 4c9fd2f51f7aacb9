#include "join_faces.hpp"

#include <cstddef>

#include "qmcf/sizing/edge_curve.hpp"

namespace qmcf {

Result<std::int64_t> relaxJoint(const Part& part, const PreparedFaces& prepared, std::vector<SharedFace>& faces,
                                const Held& held, SharedNodes& shared, double sizeScale, Progress& progress) {
  const Brep& brep = part.brep;
  std::vector<JointFace> joint;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    joint.push_back(
        {&faces[f].mesh, &faces[f].node, &prepared.patches[f], &part.faceTrees[f], held.faces[f] != 0, held.places[f]});
  }
  std::vector<JointEdge> edges;
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const bool closesSmoothly = brep.edges[e].start == brep.edges[e].end &&
                                brep.vertices[static_cast<std::size_t>(brep.edges[e].start)].artificial;
    edges.push_back(
        {edgeCurve(part.mesh, brep.edges[e]), shared.edges[e].nodes, shared.edges[e].arcLength, closesSmoothly});
    for (const std::int32_t stop : brep.edges[e].stops) {
      edges.back().stays.push_back(edges.back().curve.arcLength[static_cast<std::size_t>(stop)]);
    }
  }
  JointRelaxationOptions options;
  options.sizeScale = sizeScale;
  return relaxTogether(joint, edges, shared.positions, options, progress);
}

QuadMesh joinFaces(const SharedNodes& shared, const std::vector<SharedFace>& faces) {
  QuadMesh joined;
  std::vector<std::int32_t> vertexOf(shared.positions.size(), kNone);
  const auto vertexOfNode = [&](std::int32_t node) {
    std::int32_t& vertex = vertexOf[static_cast<std::size_t>(node)];
    if (vertex == kNone) {
      vertex = static_cast<std::int32_t>(joined.positions.size());
      joined.positions.push_back(shared.positions[static_cast<std::size_t>(node)]);
    }
    return vertex;
  };
  for (const SharedFace& face : faces) {
    std::vector<std::int32_t> vertexOfFace;
    for (std::size_t v = 0; v < face.mesh.positions.size(); ++v) {
      if (face.node[v] != kNone) {
        vertexOfFace.push_back(vertexOfNode(face.node[v]));
      } else {
        vertexOfFace.push_back(static_cast<std::int32_t>(joined.positions.size()));
        joined.positions.push_back(face.mesh.positions[v]);
      }
    }
    for (Element element : face.mesh.elements) {
      for (std::int32_t& corner : element) {
        if (corner != kNone) corner = vertexOfFace[static_cast<std::size_t>(corner)];
      }
      joined.elements.push_back(element);
      joined.elementFace.push_back(face.report.face);
    }
  }
  for (std::size_t e = 0; e < shared.edges.size(); ++e) {
    const auto& nodes = shared.edges[e].nodes;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      joined.featureSegments.push_back(
          {vertexOfNode(nodes[i]), vertexOfNode(nodes[i + 1]), static_cast<std::int32_t>(e)});
    }
  }
  return joined;
}

}  // namespace qmcf
