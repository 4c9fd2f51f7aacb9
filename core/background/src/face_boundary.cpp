#include "face_boundary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "qmcf/sizing/edge_curve.hpp"

namespace qmcf {
namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

void copySurface(RemeshMesh& mesh, const Surface& surface, const FaceReference& reference) {
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> twins;
  triangles.reserve(surface.triangleCount());
  twins.reserve(surface.halfedgeCount());
  for (const TriangleId t : surface.triangles()) {
    const auto corners = surface.corners(t);
    triangles.push_back({corners[0].value, corners[1].value, corners[2].value});
  }
  for (const HalfedgeId h : surface.halfedges()) twins.push_back(surface.twin(h).value);
  for (const VertexId v : surface.vertices()) {
    mesh.position.push_back(surface.position(v));
    mesh.normal.push_back(reference.vertexNormal(v.value));
  }
  mesh.build(triangles, twins);
  for (const VertexId v : surface.vertices()) {
    mesh.triangle[v.index()] = Surface::triangle(surface.outgoing(v)).value;
    if (mesh.onBoundary(v.value)) mesh.role[v.index()] = VertexRole::point;
  }
}

void makeNode(RemeshMesh& mesh, std::int32_t vertex, std::int32_t node, const Vec3& position) {
  mesh.role[index(vertex)] = VertexRole::node;
  mesh.node[index(vertex)] = node;
  mesh.position[index(vertex)] = position;
}

/// The nodes inside one edge in the direction of a coedge, by arc length from the coedge's start.
struct NodesOnWay {
  std::vector<std::int32_t> node;
  std::vector<double> arcLength;
};

NodesOnWay nodesOnWay(const EdgeDivision& division, bool reversed) {
  NodesOnWay way;
  const std::size_t count = division.nodes.size();
  const double length = division.arcLength.back();
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const std::size_t k = reversed ? count - 1 - i : i;
    way.node.push_back(division.nodes[k]);
    way.arcLength.push_back(reversed ? length - division.arcLength[k] : division.arcLength[k]);
  }
  return way;
}

/// Splits the boundary half-edges of one coedge (from first on, in order) at its nodes.
class CoedgeSplitter {
 public:
  CoedgeSplitter(RemeshMesh& mesh, const DividedEdges& divided, NodesOnWay way, double length)
      : mesh_(mesh), divided_(divided), way_(std::move(way)), tolerance_(1e-9 * length) {}

  /// The half-edge h covers [from, to] of the coedge. Nodes at its end are put there unless the coedge ends, too.
  void splitSegment(std::int32_t h, double from, double to, bool isLast) {
    const Vec3 startNormal = mesh_.normal[index(mesh_.origin(h))];
    const Vec3 endNormal = mesh_.normal[index(mesh_.target(h))];
    for (; next_ < way_.node.size(); ++next_) {
      const double s = way_.arcLength[next_];
      if (s > to + tolerance_) return;
      const std::int32_t node = way_.node[next_];
      const Vec3& position = divided_.nodes[index(node)];
      if (s >= to - tolerance_ && !isLast) {
        makeNode(mesh_, mesh_.target(h), node, position);
        ++next_;
        return;
      }
      const double fraction = std::clamp((s - from) / (to - from), 0.0, 1.0);
      const std::int32_t m = mesh_.split(h, position);
      mesh_.normal[index(m)] = normalized(startNormal * (1.0 - fraction) + endNormal * fraction);
      if (mesh_.normal[index(m)] == Vec3{}) mesh_.normal[index(m)] = startNormal;
      makeNode(mesh_, m, node, position);
      h = mesh_.outgoing(m);
    }
  }

 private:
  RemeshMesh& mesh_;
  const DividedEdges& divided_;
  NodesOnWay way_;
  double tolerance_;
  std::size_t next_ = 0;
};

/// Walks along the loop by its vertices: splitting a triangle's side may give its other sides new half-edges.
void splitLoop(RemeshMesh& mesh, FaceBoundary& boundary, const TriangleMesh& input, const Brep& brep,
               const BrepLoop& loop, std::int32_t start, const DividedEdges& divided) {
  std::int32_t vertex = start;
  for (const Coedge& coedge : loop.coedges) {
    const auto mark = static_cast<std::int32_t>(boundary.coedges.size());
    const BrepEdge& edge = brep.edges[index(coedge.edge)];
    const EdgeCurve curve = edgeCurve(input, edge);
    const std::size_t segments = curve.points.size() - 1;
    const std::int32_t startNode = coedge.reversed ? edge.end : edge.start;
    makeNode(mesh, vertex, startNode, divided.nodes[index(startNode)]);
    boundary.coedges.push_back(coedge);
    boundary.firstVertex.push_back(vertex);
    CoedgeSplitter splitter(mesh, divided, nodesOnWay(divided.edges[index(coedge.edge)], coedge.reversed),
                            curve.length());
    for (std::size_t i = 0; i < segments; ++i) {
      const std::size_t a = coedge.reversed ? segments - i : i;
      const std::size_t b = coedge.reversed ? a - 1 : a + 1;
      const double from = coedge.reversed ? curve.length() - curve.arcLength[a] : curve.arcLength[a];
      const double to = coedge.reversed ? curve.length() - curve.arcLength[b] : curve.arcLength[b];
      const std::int32_t h = mesh.outgoing(vertex);
      vertex = mesh.target(h);
      mesh.setMark(h, mark);
      splitter.splitSegment(h, from, to, i + 1 == segments);
    }
  }
}

void measureSpacing(const RemeshMesh& mesh, FaceBoundary& boundary, const DividedEdges& divided) {
  boundary.nodeSize.assign(mesh.position.size(), 0.0);
  boundary.spacing.assign(mesh.position.size(), 0.0);
  for (std::int32_t v = 0; v < mesh.vertexCount(); ++v) {
    if (mesh.role[index(v)] != VertexRole::node) continue;
    boundary.nodeSize[index(v)] = divided.nodeSize[index(mesh.node[index(v)])];
    std::int32_t after = mesh.target(mesh.outgoing(v));
    while (mesh.role[index(after)] != VertexRole::node) after = mesh.target(mesh.outgoing(after));
    const double length = distance(mesh.positionOf(v), mesh.positionOf(after));
    boundary.spacing[index(v)] += 0.5 * length;
    boundary.spacing[index(after)] += 0.5 * length;
  }
}

}  // namespace

FaceBoundary insertNodes(RemeshMesh& mesh, const TriangleMesh& input, const Brep& brep, std::int32_t face,
                         const FaceSurface& cut, const FaceReference& reference, const DividedEdges& divided) {
  copySurface(mesh, cut.surface, reference);
  FaceBoundary boundary;
  const BrepFace& from = brep.faces[index(face)];
  for (std::size_t l = 0; l < from.loops.size(); ++l) {
    splitLoop(mesh, boundary, input, brep, from.loops[l], cut.surface.origin(cut.loops[l].front()).value, divided);
  }
  measureSpacing(mesh, boundary, divided);
  return boundary;
}

}  // namespace qmcf
