#include "join_faces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "qmcf/sizing/edge_curve.hpp"
#include "qmcf/sizing/slits.hpp"

namespace qmcf {
namespace {

/// Nodes across from each other at a slit stay so.
void keepAcross(const Part& part, std::vector<JointEdge>& edges) {
  std::vector<EdgeCurve> curves;
  for (const JointEdge& edge : edges) curves.push_back(edge.curve);
  const double width = slitWidth(part.mesh);
  for (const auto& slit : findSlits(part.brep, curves, width)) {
    JointEdge& one = edges[static_cast<std::size_t>(slit[0])];
    JointEdge& other = edges[static_cast<std::size_t>(slit[1])];
    for (const double s : one.arcLength) {
      const auto across = acrossSlit(other.curve, one.curve.at(s), width);
      if (!across) continue;
      const auto node = std::find_if(other.arcLength.begin(), other.arcLength.end(),
                                     [&](double t) { return std::fabs(t - *across) <= width; });
      if (node == other.arcLength.end()) continue;
      one.stays.push_back(s);
      other.stays.push_back(*node);
    }
  }
  for (JointEdge& edge : edges) std::sort(edge.stays.begin(), edge.stays.end());
}

}  // namespace

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
  keepAcross(part, edges);
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
