#include "face_surface.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>

#include "triangle_edges.hpp"

namespace qmcf {
namespace {

/// A mesh edge on an edge of the B-rep; sorted by its ends.
struct CutEdge {
  std::array<std::int32_t, 2> ends;
  std::int32_t brepEdge;
  friend bool operator<(const CutEdge& a, const CutEdge& b) { return a.ends < b.ends; }
};

std::vector<CutEdge> cutEdges(const Brep& brep, const BrepFace& face) {
  std::vector<std::int32_t> used;
  for (const BrepLoop& loop : face.loops) {
    for (const Coedge& coedge : loop.coedges) used.push_back(coedge.edge);
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<CutEdge> cuts;
  for (const std::int32_t e : used) {
    const auto& points = brep.edges[static_cast<std::size_t>(e)].points;
    for (std::size_t i = 1; i < points.size(); ++i) {
      cuts.push_back({{std::min(points[i - 1], points[i]), std::max(points[i - 1], points[i])}, e});
    }
  }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

/// The face's triangles with vertices numbered from 0 in the order of the mesh; `points` gets the mesh's numbers.
detail::Triangles localTriangles(const TriangleMesh& mesh, const BrepFace& face, std::vector<std::int32_t>& points) {
  detail::Triangles local;
  local.reserve(face.triangles.size());
  for (const std::int32_t t : face.triangles) {
    local.push_back(mesh.triangles[static_cast<std::size_t>(t)]);
    points.insert(points.end(), local.back().begin(), local.back().end());
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (auto& corners : local) {
    for (std::int32_t& v : corners) {
      v = static_cast<std::int32_t>(std::lower_bound(points.begin(), points.end(), v) - points.begin());
    }
  }
  return local;
}

/// The mesh vertices at the ends of the face's edges, ascending.
std::vector<std::int32_t> cornerPoints(const Brep& brep, const BrepFace& face) {
  std::vector<std::int32_t> corners;
  for (const BrepLoop& loop : face.loops) {
    for (const Coedge& coedge : loop.coedges) {
      const BrepEdge& edge = brep.edges[static_cast<std::size_t>(coedge.edge)];
      corners.insert(corners.end(), {edge.points.front(), edge.points.back()});
    }
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// The same walk over the same half-edges in the same order as in recoverBrep() gives the same loops.
std::vector<std::vector<HalfedgeId>> traceLoops(const detail::TriangleEdges& edges, const detail::Fans& fans,
                                                const IdMap<detail::EdgeId, std::uint8_t>& cut,
                                                const std::vector<std::int32_t>& points,
                                                const std::vector<std::int32_t>& corners) {
  std::vector<std::vector<HalfedgeId>> loops;
  std::vector<std::uint8_t> visited(edges.halfedgeCount(), 0);
  for (const HalfedgeId first : edges.halfedges()) {
    if (visited[first.index()] != 0 || cut[edges.edge(first)] == 0) continue;
    if (!std::binary_search(corners.begin(), corners.end(), points[edges.origin(first).index()])) continue;
    std::vector<HalfedgeId> loop;
    for (HalfedgeId h = first; visited[h.index()] == 0; h = nextCut(fans, h)) {
      visited[h.index()] = 1;
      loop.push_back(h);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// A broken invariant: what comes next would look for what is not there.
Error uncutError(std::int32_t face) {
  return {ErrorCode::internal, "Face " + std::to_string(face) + " could not be cut out along its edges.", {face}};
}

}  // namespace

Result<FaceSurface> detail::cutFace(const TriangleMesh& mesh, const Brep& brep, std::int32_t face) {
  const BrepFace& source = brep.faces[static_cast<std::size_t>(face)];
  std::vector<std::int32_t> points;
  const detail::Triangles local = localTriangles(mesh, source, points);
  const detail::TriangleEdges edges(local, points.size());
  const std::vector<CutEdge> cuts = cutEdges(brep, source);

  IdMap<detail::EdgeId, std::int32_t> brepEdge(edges.edgeCount(), kNone);
  IdMap<detail::EdgeId, std::uint8_t> cut(edges.edgeCount(), 0);
  for (const detail::EdgeId e : edges.edges()) {
    const auto ends = edges.ends(e);
    const CutEdge key{{points[ends[0].index()], points[ends[1].index()]}, kNone};
    const auto found = std::lower_bound(cuts.begin(), cuts.end(), key);
    if (found == cuts.end() || key < *found) continue;
    brepEdge[e] = found->brepEdge;
    cut[e] = 1;
  }
  // Each fan of corners between cuts is a vertex of the surface.
  const detail::Fans fans = detail::buildFans(edges, cut);
  FaceSurface result;
  std::vector<Vec3> positions;
  for (const HalfedgeId h : fans.first) {
    const std::int32_t point = points[edges.origin(h).index()];
    result.vertexPoint.push_back(point);
    positions.push_back(mesh.positions[static_cast<std::size_t>(point)]);
  }
  detail::Triangles triangles(local.size());
  for (const HalfedgeId h : edges.halfedges()) triangles[h.index() / 3][h.index() % 3] = fans.ofCorner[h];
  Result<Surface> built = Surface::build(std::move(positions), triangles);
  assert(built.ok());
  if (!built) return uncutError(face);
  result.surface = std::move(built).value();
  result.triangleOrigin = source.triangles;

  result.edge.resize(edges.halfedgeCount(), kNone);
  for (const HalfedgeId h : edges.halfedges()) result.edge[h] = brepEdge[edges.edge(h)];
  result.loops = traceLoops(edges, fans, cut, points, cornerPoints(brep, source));
  assert(result.loops.size() == source.loops.size());
  if (result.loops.size() != source.loops.size()) return uncutError(face);
  return result;
}

}  // namespace qmcf
