#include "mesh_faces.hpp"

#include <cstddef>
#include <utility>

#include "qmcf/cleanup/cleanup.hpp"
#include "qmcf/front/advancing_front.hpp"
#include "qmcf/qmorph/qmorph.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"
#include "too_coarse.hpp"

namespace qmcf {
namespace {

TriangleBvh faceTree(const TriangleMesh& mesh, const BrepFace& face) {
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const std::int32_t t : face.triangles) triangles.push_back(mesh.triangles[static_cast<std::size_t>(t)]);
  return TriangleBvh(mesh.positions, triangles);
}

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

void count(MeshedFace& face) {
  for (const Element& element : face.mesh.elements)
    ++(cornerCount(element) == 4 ? face.report.quads : face.report.triangles);
}

/// The front of the chosen mode, before the clean-up.
Result<FaceMesh> advance(const Patch& patch, const PreparedFaces& prepared, const TriangleBvh& tree, std::size_t face,
                         Mode mode, Progress& progress) {
  if (mode == Mode::qmorph) {
    auto front = advanceMorph(patch, tree, MorphOptions{}, progress);
    if (!front) return front.error();
    return std::move(front.value().mesh);
  }
  auto front = advanceFront(patch, prepared.fields[face], FrontOptions{}, progress);
  if (!front) return front.error();
  return std::move(front.value().mesh);
}

}  // namespace

Result<MeshedFace> meshFace(const TriangleMesh& mesh, const Brep& brep, const PreparedFaces& prepared,
                            std::int32_t face, const MeshOptions& options, Progress& progress) {
  const auto f = static_cast<std::size_t>(face);
  const Patch& patch = prepared.patches[f];
  const TriangleBvh tree = faceTree(mesh, brep.faces[f]);
  MeshedFace result;
  result.report.face = face;

  auto front = advance(patch, prepared, tree, f, options.mode, progress);
  if (!front) return front.error();
  auto cleaned = cleanUp(front.value(), patch, tree, CleanupOptions{}, progress);
  if (!cleaned) return cleaned.error();
  if (cleaned.value().degenerate.empty()) {
    result.mesh = std::move(cleaned.value().mesh);
    result.report.method = modeName(options.mode);
    count(result);
    return result;
  }
  result.report.reason = "the advancing front left elements without area or turned in on themselves";
  result.tooCoarse = halvedAt(cleaned.value().mesh, cleaned.value().degenerate, face);
  auto paired = cleanUp(recombinePatch(patch).mesh, patch, tree, CleanupOptions{}, progress);
  if (!paired) return paired.error();
  if (paired.value().degenerate.empty()) {
    result.mesh = std::move(paired.value().mesh);
    result.report.method = "recombined";
  } else {
    result.mesh = trianglesOf(patch);
    result.report.method = "triangles";
    result.report.reason += ", and so did pairing triangles";
  }
  count(result);
  return result;
}

QuadMesh joinFaces(const Brep& brep, const PreparedFaces& prepared, const std::vector<MeshedFace>& faces) {
  QuadMesh joined;
  std::vector<std::int32_t> nodeVertex(prepared.divided.nodes.size(), kNone);
  const auto vertexOfNode = [&](std::int32_t node) {
    std::int32_t& vertex = nodeVertex[static_cast<std::size_t>(node)];
    if (vertex == kNone) {
      vertex = static_cast<std::int32_t>(joined.positions.size());
      joined.positions.push_back(prepared.divided.nodes[static_cast<std::size_t>(node)]);
    }
    return vertex;
  };
  for (const MeshedFace& face : faces) {
    const Patch& patch = prepared.patches[static_cast<std::size_t>(face.report.face)];
    std::vector<std::int32_t> vertexOf;
    for (std::size_t v = 0; v < face.mesh.positions.size(); ++v) {
      const std::int32_t patchVertex = face.mesh.patchVertex[v];
      if (patchVertex != kNone) {
        vertexOf.push_back(vertexOfNode(patch.node[VertexId(patchVertex)]));
      } else {
        vertexOf.push_back(static_cast<std::int32_t>(joined.positions.size()));
        joined.positions.push_back(face.mesh.positions[v]);
      }
    }
    for (Element element : face.mesh.elements) {
      for (std::int32_t& corner : element) {
        if (corner != kNone) corner = vertexOf[static_cast<std::size_t>(corner)];
      }
      joined.elements.push_back(element);
      joined.elementFace.push_back(face.report.face);
    }
  }
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const auto& nodes = prepared.divided.edges[e].nodes;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      joined.featureSegments.push_back(
          {vertexOfNode(nodes[i]), vertexOfNode(nodes[i + 1]), static_cast<std::int32_t>(e)});
    }
  }
  return joined;
}

}  // namespace qmcf
