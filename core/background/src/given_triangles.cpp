#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

#include "qmcf/background/background.hpp"

namespace qmcf {
namespace {

/// Means of the triangles' normals, weighted by area.
void setNormals(Patch& patch) {
  patch.normal.resize(patch.surface.vertexCount());
  for (const TriangleId t : patch.surface.triangles()) {
    const auto corners = patch.surface.corners(t);
    const Vec3& a = patch.surface.position(corners[0]);
    const Vec3 area = cross(patch.surface.position(corners[1]) - a, patch.surface.position(corners[2]) - a);
    for (const VertexId v : corners) patch.normal[v] += area;
  }
  for (const VertexId v : patch.surface.vertices()) patch.normal[v] = normalized(patch.normal[v]);
}

/// Walks along a loop: its coedges one after the other, each with the nodes of its edge.
void setNodes(Patch& patch, const BrepLoop& loop, const std::vector<HalfedgeId>& sides, const DividedEdges& divided) {
  std::size_t side = 0;
  for (const Coedge& coedge : loop.coedges) {
    std::vector<std::int32_t> nodes = divided.edges[static_cast<std::size_t>(coedge.edge)].nodes;
    if (coedge.reversed) std::reverse(nodes.begin(), nodes.end());
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i, ++side) {
      const VertexId v = patch.surface.origin(sides[side]);
      patch.node[v] = nodes[i];
      patch.cornerQuads[v] = i == 0 ? coedge.cornerQuads : 2;
    }
  }
  assert(side == sides.size());
}

}  // namespace

Patch givenTriangles(const Brep& brep, std::int32_t face, const SizeField& size, const DividedEdges& divided) {
  const FaceSurface& cut = brep.cuts[static_cast<std::size_t>(face)];
  Patch patch;
  patch.face = face;
  patch.surface = cut.surface;
  patch.edge = cut.edge;
  setNormals(patch);
  patch.node.resize(patch.surface.vertexCount(), kNone);
  patch.cornerQuads.resize(patch.surface.vertexCount(), 0);
  for (const std::int32_t point : cut.vertexPoint) patch.size.push_back(size.value[static_cast<std::size_t>(point)]);
  const BrepFace& brepFace = brep.faces[static_cast<std::size_t>(face)];
  for (std::size_t l = 0; l < brepFace.loops.size(); ++l) setNodes(patch, brepFace.loops[l], cut.loops[l], divided);
  return patch;
}

}  // namespace qmcf
