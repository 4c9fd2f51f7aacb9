#include "mesh_faces.hpp"

#include <array>
#include <cassert>
#include <cstddef>
#include <optional>
#include <utility>

#include "face_tree.hpp"
#include "qmcf/cleanup/cleanup.hpp"
#include "qmcf/cleanup/subdivide.hpp"
#include "qmcf/front/advancing_front.hpp"
#include "qmcf/qmorph/qmorph.hpp"
#include "qmcf/quality/quality.hpp"
#include "qmcf/sizing/edge_curve.hpp"
#include "qmcf/topology/brep.hpp"
#include "too_coarse.hpp"

namespace qmcf {
namespace {

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
  face.report.quads = face.report.triangles = 0;
  for (const Element& element : face.mesh.elements)
    ++(cornerCount(element) == 4 ? face.report.quads : face.report.triangles);
}

/// Whether the ledger of a face's mesh closes with the Euler characteristic of the part's face, counted on the part.
[[maybe_unused]] bool ledgerCloses(const FaceMesh& made, const TriangleMesh& mesh, const Brep& brep,
                                   std::int32_t face) {
  const IndexLedger ledger = indexLedger(made.positions, made.elements);
  return ledger.closes() && ledger.sum() == 4 * faceSurface(mesh, brep, face).surface.eulerCharacteristic();
}

/// Where a front that nothing else starts is tried, as shares of the triangles.
constexpr std::array<double, 4> kSeedPlaces{0.0, 0.37, 0.61, 0.83};

/// A division of an edge of the B-rep.
struct Division {
  std::int32_t edge = kNone;
  std::size_t index = 0;  ///< Of its first node.
};

/// The division under a boundary half-edge of a patch. \pre patch.edge[h] is an edge
Division divisionOf(const Patch& patch, HalfedgeId h, const DividedEdges& divided) {
  const std::int32_t edge = patch.edge[h];
  const std::int32_t a = patch.node[patch.surface.origin(h)];
  const std::int32_t b = patch.node[patch.surface.target(h)];
  const auto& nodes = divided.edges[static_cast<std::size_t>(edge)].nodes;
  std::size_t i = 0;
  while (i + 2 < nodes.size() && !(nodes[i] == a && nodes[i + 1] == b) && !(nodes[i] == b && nodes[i + 1] == a)) ++i;
  return {edge, i};
}

/// Area of a face mesh, and its share of triangles.
struct Yield {
  double area = 0.0;
  double triangleShare = 0.0;
};

Yield yieldOf(const FaceMesh& mesh) {
  Yield yield;
  for (const Element& element : mesh.elements) {
    const auto p = [&](std::size_t i) -> const Vec3& { return mesh.positions[static_cast<std::size_t>(element[i])]; };
    const bool quad = cornerCount(element) == 4;
    yield.area += 0.5 * norm(quad ? cross(p(2) - p(0), p(3) - p(1)) : cross(p(1) - p(0), p(2) - p(0)));
    yield.triangleShare += quad ? 0.0 : 1.0 / static_cast<double>(mesh.elements.size());
  }
  return yield;
}

/// Whether a front got stuck: most of what it should have made is bridged by triangles.
bool gotStuck(const FaceMesh& mesh, const Patch& patch) {
  constexpr double kMostTriangles = 0.3;
  constexpr double kLeastArea = 0.9;
  constexpr std::size_t kFew = 12;
  const Yield yield = yieldOf(mesh);
  const bool isSmall = mesh.elements.size() < kFew && patch.surface.triangleCount() < 4 * kFew;
  return !isSmall &&
         (yield.triangleShare > kMostTriangles || yield.area < kLeastArea * yieldOf(trianglesOf(patch)).area);
}

/// The front of the chosen mode, before the clean-up. seedPlace: where a front starts that nothing else does.
Result<FaceMesh> advance(const Patch& patch, const PreparedFaces& prepared, const TriangleBvh& tree, std::size_t face,
                         Mode mode, double seedPlace, Progress& progress, TraceRecorder* trace) {
  if (mode == Mode::qmorph) {
    auto front = advanceMorph(patch, tree, MorphOptions{}, progress, trace);
    if (!front) return front.error();
    return std::move(front.value().mesh);
  }
  FrontOptions frontOptions;
  frontOptions.seedPlace = seedPlace;
  auto front = advanceFront(patch, prepared.fields[face], frontOptions, progress, trace);
  if (!front) return front.error();
  return std::move(front.value().mesh);
}

}  // namespace

Result<MeshedFace> meshFace(const TriangleMesh& mesh, const Brep& brep, const PreparedFaces& prepared,
                            std::int32_t face, const MeshOptions& options, const std::optional<TraceScale>& scale,
                            Progress& progress) {
  const auto f = static_cast<std::size_t>(face);
  const Patch& patch = prepared.patches[f];
  const TriangleBvh tree = faceTree(mesh, brep.faces[f]);
  MeshedFace result;
  result.report.face = face;
  std::optional<TraceRecorder> recorder;
  if (scale) recorder.emplace(result.trace, *scale);
  TraceRecorder* const trace = recorder ? &*recorder : nullptr;

  // A front that got stuck may do better from another start, where the start is free.
  bool isStuck = true;
  Result<FaceMesh> front = FaceMesh{};
  for (std::size_t start = 0; isStuck && start < (brep.faces[f].loops.empty() ? kSeedPlaces.size() : 1); ++start) {
    front = advance(patch, prepared, tree, f, options.mode, kSeedPlaces[start], progress, trace);
    if (!front) return front.error();
    assert(ledgerCloses(front.value(), mesh, brep, face));
    isStuck = gotStuck(front.value(), patch);
  }
  auto cleaned = cleanUp(front.value(), patch, tree, CleanupOptions{}, progress, trace);
  if (!cleaned) return cleaned.error();
  assert(ledgerCloses(cleaned.value().mesh, mesh, brep, face));
  if (cleaned.value().degenerate.empty() && !isStuck) {
    result.mesh = std::move(cleaned.value().mesh);
    result.report.method = modeName(options.mode);
    count(result);
    return result;
  }
  result.report.reason = isStuck ? "the advancing front got stuck and left more than triangles can bridge well"
                                 : "the advancing front left elements without area or turned in on themselves";
  result.tooCoarse = halvedAt(cleaned.value().mesh, cleaned.value().degenerate, face);
  auto paired = cleanUp(recombinePatch(patch).mesh, patch, tree, CleanupOptions{}, progress, trace, TraceKind::paired);
  if (!paired) return paired.error();
  if (paired.value().degenerate.empty()) {
    result.mesh = std::move(paired.value().mesh);
    result.report.method = "recombined";
  } else {
    result.mesh = trianglesOf(patch);
    result.report.method = "triangles";
    result.report.reason += ", and so did pairing triangles";
    if (trace != nullptr) {
      EditMesh work(result.mesh);
      trace->begin(TraceKind::triangulated, work);
    }
  }
  assert(ledgerCloses(result.mesh, mesh, brep, face));
  count(result);
  return result;
}

Result<MeshedFace> subdivideFace(const TriangleMesh& mesh, const Brep& brep, const PreparedFaces& prepared,
                                 const MeshedFace& face, const std::optional<TraceScale>& scale, Progress& progress) {
  const auto f = static_cast<std::size_t>(face.report.face);
  const Patch& patch = prepared.patches[f];
  const TriangleBvh tree = faceTree(mesh, brep.faces[f]);
  IdMap<HalfedgeId, Vec3> middle(patch.surface.halfedgeCount());
  std::vector<std::optional<EdgeCurve>> curves(brep.edges.size());
  for (const HalfedgeId h : IdRange<HalfedgeId>(patch.surface.halfedgeCount())) {
    if (!patch.surface.isBoundary(h)) continue;
    const Division division = divisionOf(patch, h, prepared.divided);
    const auto e = static_cast<std::size_t>(division.edge);
    const auto& arc = prepared.divided.edges[e].arcLength;
    const double s = 0.5 * (arc[division.index] + arc[division.index + 1]);
    if (!curves[e]) curves[e] = edgeCurve(mesh, brep.edges[e]);
    middle[h] = curves[e]->at(s);
  }
  SubdividedFace cut = subdivide(face.mesh, patch, tree, middle);
  CleanupOptions options;
  options.topology = false;
  options.quadsOnly = true;
  options.sizeScale = 0.5;
  MeshedFace result = face;
  std::optional<TraceRecorder> recorder;
  if (scale) recorder.emplace(result.trace, *scale);
  auto relaxed =
      cleanUp(cut.mesh, patch, tree, options, progress, recorder ? &*recorder : nullptr, TraceKind::subdivision);
  if (!relaxed) return relaxed.error();
  assert(ledgerCloses(relaxed.value().mesh, mesh, brep, face.report.face));
  result.mesh = std::move(relaxed.value().mesh);
  result.boundaryEdge = std::move(cut.boundaryEdge);
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
  // Per division of each edge, the vertex that halves it; used only where the faces were subdivided.
  std::vector<std::vector<std::int32_t>> halves(brep.edges.size());
  for (std::size_t e = 0; e < brep.edges.size(); ++e)
    halves[e].assign(prepared.divided.edges[e].nodes.size() - 1, kNone);
  for (const MeshedFace& face : faces) {
    const Patch& patch = prepared.patches[static_cast<std::size_t>(face.report.face)];
    std::vector<std::int32_t> vertexOf;
    for (std::size_t v = 0; v < face.mesh.positions.size(); ++v) {
      const std::int32_t patchVertex = face.mesh.patchVertex[v];
      if (patchVertex != kNone) {
        vertexOf.push_back(vertexOfNode(patch.node[VertexId(patchVertex)]));
      } else if (!face.boundaryEdge.empty() && face.boundaryEdge[v].valid()) {
        const Division division = divisionOf(patch, face.boundaryEdge[v], prepared.divided);
        std::int32_t& half = halves[static_cast<std::size_t>(division.edge)][division.index];
        if (half == kNone) {
          half = static_cast<std::int32_t>(joined.positions.size());
          joined.positions.push_back(face.mesh.positions[v]);
        }
        vertexOf.push_back(half);
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
      const auto edge = static_cast<std::int32_t>(e);
      const std::int32_t a = vertexOfNode(nodes[i]);
      const std::int32_t b = vertexOfNode(nodes[i + 1]);
      const std::int32_t half = halves[e][i];
      if (half == kNone) {
        joined.featureSegments.push_back({a, b, edge});
      } else {
        joined.featureSegments.push_back({a, half, edge});
        joined.featureSegments.push_back({half, b, edge});
      }
    }
  }
  return joined;
}

}  // namespace qmcf
