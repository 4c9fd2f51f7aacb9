#include "feature_edges.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "coordinate_noise.hpp"
#include "qmcf/base/bounding_box.hpp"
#include "qmcf/base/math.hpp"

namespace qmcf::detail {
namespace {

const Vec3& point(const TriangleMesh& mesh, VertexId v) { return mesh.positions[v.index()]; }

/// How far the coordinates may be from what the author meant: the resolution of single precision if all of them are
/// such numbers, and six digits of the size of the part in any case.
double coordinateNoise(const TriangleMesh& mesh) {
  BoundingBox box;
  for (const Vec3& p : mesh.positions) box.include(p);
  return std::fmax(2e-7 * box.diagonal(), 4.0 * coordinateResolution(mesh.positions, box));
}

/// A triangle's normal is trusted when noise turns it by less than 1 / kTrust radians.
constexpr double kTrust = 20.0;

struct Normals {
  std::vector<Vec3> unit;
  std::vector<std::uint8_t> trusted;
};

Normals triangleNormals(const TriangleMesh& mesh) {
  const double noise = coordinateNoise(mesh);
  Normals normals;
  normals.unit.resize(mesh.triangles.size());
  normals.trusted.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    const Vec3& p0 = mesh.positions[static_cast<std::size_t>(c[0])];
    const Vec3& p1 = mesh.positions[static_cast<std::size_t>(c[1])];
    const Vec3& p2 = mesh.positions[static_cast<std::size_t>(c[2])];
    const Vec3 area = cross(p1 - p0, p2 - p0);
    const double longest = std::fmax(std::fmax(distance(p0, p1), distance(p1, p2)), distance(p2, p0));
    normals.unit[t] = normalized(area);
    normals.trusted[t] = norm(area) > kTrust * noise * longest ? 1 : 0;
  }
  return normals;
}

/// Gives each sliver the normal of a trusted triangle it hangs together with, along the longest edges first: then a
/// sliver beside a crease belongs to one side of it, and exactly one of its edges is sharp.
void replaceSliverNormals(const TriangleMesh& mesh, const TriangleEdges& edges, Normals& normals) {
  struct Link {
    double length;
    HalfedgeId from;  ///< In the trusted triangle.
    bool operator<(const Link& other) const {
      return length != other.length ? length < other.length : from > other.from;
    }
  };
  std::priority_queue<Link> links;
  const auto offer = [&](TriangleId t) {
    for (int c = 0; c < 3; ++c) {
      const HalfedgeId h = Surface::halfedge(t, c);
      if (!edges.isManifold(edges.edge(h))) continue;
      if (normals.trusted[Surface::triangle(edges.other(h)).index()] != 0) continue;
      links.push({distance(point(mesh, edges.origin(h)), point(mesh, edges.target(h))), h});
    }
  };
  for (const TriangleId t : edges.triangles()) {
    if (normals.trusted[t.index()] != 0) offer(t);
  }
  while (!links.empty()) {
    const HalfedgeId h = links.top().from;
    links.pop();
    const TriangleId sliver = Surface::triangle(edges.other(h));
    if (normals.trusted[sliver.index()] != 0) continue;
    normals.trusted[sliver.index()] = 1;
    normals.unit[sliver.index()] = normals.unit[Surface::triangle(h).index()];
    offer(sliver);
  }
}

/// Labels count as a division into faces when their connected regions have a few triangles each. Exporters that give
/// every polygon its own group say nothing about the part.
bool labelsAreFaces(const TriangleMesh& mesh, const TriangleEdges& edges) {
  if (mesh.labels.size() != mesh.triangles.size()) return false;
  constexpr std::size_t kTrianglesPerRegion = 4;
  std::vector<std::uint8_t> visited(mesh.triangles.size(), 0);
  std::vector<TriangleId> stack;
  std::size_t regions = 0;
  for (const TriangleId root : edges.triangles()) {
    if (visited[root.index()] != 0) continue;
    ++regions;
    visited[root.index()] = 1;
    stack.push_back(root);
    while (!stack.empty()) {
      const TriangleId t = stack.back();
      stack.pop_back();
      for (int c = 0; c < 3; ++c) {
        const HalfedgeId g = edges.other(Surface::halfedge(t, c));
        if (!g.valid()) continue;
        const TriangleId u = Surface::triangle(g);
        if (visited[u.index()] != 0 || mesh.labels[u.index()] != mesh.labels[t.index()]) continue;
        visited[u.index()] = 1;
        stack.push_back(u);
      }
    }
  }
  return regions * kTrianglesPerRegion <= mesh.triangles.size();
}

}  // namespace

FeatureEdges markFeatureEdges(const TriangleMesh& mesh, const TriangleEdges& edges, double featureAngle) {
  Normals normals = triangleNormals(mesh);
  replaceSliverNormals(mesh, edges, normals);
  const bool useLabels = labelsAreFaces(mesh, edges);

  FeatureEdges features;
  features.mark.resize(edges.edgeCount(), 0);
  features.dihedral.resize(edges.edgeCount(), 0.0);
  for (const EdgeId e : edges.edges()) {
    const auto uses = edges.uses(e);
    if (uses.size() == 1) {
      features.set(e, EdgeKind::boundary);
      continue;
    }
    if (!edges.isManifold(e)) {
      features.set(e, EdgeKind::nonManifold);
      continue;
    }
    const std::size_t t = Surface::triangle(uses[0]).index();
    const std::size_t u = Surface::triangle(uses[1]).index();
    const Vec3 axis = cross(normals.unit[t], normals.unit[u]);
    features.dihedral[e] = math::atan2(norm(axis), dot(normals.unit[t], normals.unit[u]));
    if (features.dihedral[e] >= featureAngle) {
      features.set(e, EdgeKind::sharp);
    } else if (useLabels && mesh.labels[t] != mesh.labels[u]) {
      features.set(e, EdgeKind::label);
    }
  }
  return features;
}

}  // namespace qmcf::detail
