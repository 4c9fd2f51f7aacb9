// Local smoothing: step 4d of section 4.1 (Owen et al. 1999), with the front nodes of Blacker and Stephenson 1991 (C7).
#include "smoothing.hpp"

#include <algorithm>
#include <cmath>

#include "qmcf/mesh/element_shape.hpp"

namespace qmcf {
namespace {

/// Front edges differing less in length keep the distance of their node from the row behind.
constexpr double kEvenRatio = 2.5;
constexpr double kUnevenRatio = 20.0;
/// Elements may get worse by smoothing, but not worse than this.
constexpr double kLeastShape = 0.2;

/// A front node with the quads behind it.
struct FrontNode {
  VertexId node;
  HalfedgeId front;    ///< Front edge that leaves it.
  VertexId behind;     ///< Node that its two quads share with it; invalid unless there are exactly two.
  Vec3 parallelogram;  ///< Mean of the places that would make its quads parallelograms.
  int quads = 0;
  int sectors = 0;
};

FrontNode lookAt(const MorphMesh& morph, VertexId v) {
  const EditMesh& mesh = morph.mesh();
  FrontNode result;
  result.node = v;
  mesh.forEachOutgoing(v, [&](HalfedgeId h) {
    if (morph.front().isFront(h)) {
      result.front = h;
      ++result.sectors;
    }
    if (mesh.isOpen(h)) return;
    const HalfedgeId t = mesh.twin(h);
    if (t.valid() && !mesh.isOpen(t)) result.behind = mesh.target(h);
    if (mesh.cornerCount(mesh.face(h)) != 4) return;
    const HalfedgeId n = mesh.next(h);
    result.parallelogram +=
        mesh.position(mesh.origin(n)) + mesh.position(mesh.origin(mesh.prev(h))) - mesh.position(mesh.target(n));
    ++result.quads;
  });
  if (result.quads > 0) result.parallelogram = result.parallelogram / result.quads;
  if (result.quads != 2) result.behind = VertexId();
  return result;
}

Vec3 weightedMean(const EditMesh& mesh, VertexId v) {
  const Vec3 p = mesh.position(v);
  Vec3 sum;
  double weight = 0.0;
  mesh.forEachOutgoing(v, [&](HalfedgeId h) {
    const Vec3 edge = mesh.position(mesh.target(h)) - p;
    const double length = norm(edge);
    sum += edge * length;
    weight += length;
  });
  return weight > 0.0 ? p + sum / weight : p;
}

/// The distance that a front node should have from the node behind it.
double wantedDistance(const MorphMesh& morph, const FrontNode& node) {
  const EditMesh& mesh = morph.mesh();
  const double ratio = morph.lengthRatio(node.front);
  if (ratio <= kEvenRatio) return distance(mesh.position(node.node), mesh.position(node.behind));
  double sum = 0.0;
  int count = 0;
  mesh.forEachOutgoing(node.node, [&](HalfedgeId h) {
    const bool ahead = mesh.isOpen(h) && !morph.front().isFront(h);
    if (ahead || ratio > kUnevenRatio) {
      sum += morph.length(h);
      ++count;
    }
    if (mesh.isOpen(h) || ratio > kUnevenRatio || mesh.cornerCount(mesh.face(h)) != 4) return;
    // The two sides of the quad that the node is not on.
    const HalfedgeId n = mesh.next(h);
    sum += morph.length(n) + morph.length(mesh.next(n));
    count += 2;
  });
  return count > 0 ? sum / count : distance(mesh.position(node.node), mesh.position(node.behind));
}

/// Along the direction halfway between the node's own and the bisector of its neighbours, seen from the node behind.
Vec3 angularPlace(const MorphMesh& morph, const FrontNode& node, double wanted, const Vec3& otherwise) {
  const EditMesh& mesh = morph.mesh();
  const Vec3 origin = mesh.position(node.behind);
  const Vec3 own = mesh.position(node.node) - origin;
  const Vec3 after = mesh.position(mesh.target(node.front)) - origin;
  const Vec3 before = mesh.position(mesh.origin(morph.front().previousFront(node.front))) - origin;
  const Vec3 bisector = normalized(normalized(after) + normalized(before));
  if (!(dot(bisector, own) > 0.0)) return otherwise;
  const Vec3 direction = normalized(bisector + normalized(own));
  // Distance at which the direction meets the chord between the neighbours, in the plane of the node behind.
  const Vec3 across = cross(mesh.normal(node.behind), before - after);
  const double along = dot(direction, across);
  const double chord = std::fabs(along) > 0.0 ? dot(after, across) / along : wanted;
  const double length = chord > 0.0 && wanted > chord ? 0.5 * (wanted + chord) : wanted;
  return origin + direction * length;
}

Vec3 smoothedPlace(const MorphMesh& morph, VertexId v) {
  const FrontNode node = lookAt(morph, v);
  if (node.sectors == 0 || node.quads == 0) return weightedMean(morph.mesh(), v);
  if (!node.behind.valid() || node.sectors != 1) return node.parallelogram;
  const double wanted = wantedDistance(morph, node);
  const Vec3 origin = morph.mesh().position(node.behind);
  const Vec3 straight = origin + normalized(node.parallelogram - origin) * wanted;
  return (straight + angularPlace(morph, node, wanted, straight)) * 0.5;
}

/// The nodes, then those joined to them.
std::vector<VertexId> withNeighbours(const EditMesh& mesh, const std::vector<VertexId>& nodes) {
  std::vector<VertexId> neighbours;
  for (const VertexId v : nodes) {
    mesh.forEachOutgoing(v, [&](HalfedgeId h) {
      neighbours.push_back(mesh.target(h));
      neighbours.push_back(mesh.origin(mesh.prev(h)));
    });
  }
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  std::erase_if(neighbours, [&](VertexId v) { return std::find(nodes.begin(), nodes.end(), v) != nodes.end(); });
  std::vector<VertexId> all = nodes;
  all.insert(all.end(), neighbours.begin(), neighbours.end());
  return all;
}

/// Moves a node to the given place, or part of the way, if the worst element around it gets better.
void improve(MorphMesh& morph, VertexId v, const Vec3& aim) {
  EditMesh& mesh = morph.mesh();
  const EditMesh::Vertex from = mesh.vertex(v);
  const double before = worstShapeAround(mesh, v);
  constexpr int kHalvings = 3;
  double step = 1.0;
  for (int i = 0; i <= kHalvings; ++i, step *= 0.5) {
    const std::size_t mark = mesh.mark();
    mesh.setVertex(v, morph.place(from, from.position + (aim - from.position) * step));
    if (worstShapeAround(mesh, v) > before) return;
    mesh.rollback(mark);
  }
}

}  // namespace

std::vector<VertexId> smoothAround(MorphMesh& morph, const std::vector<VertexId>& nodes) {
  const EditMesh& mesh = morph.mesh();
  std::vector<VertexId> order = withNeighbours(mesh, nodes);
  for (const VertexId v : order) {
    if (morph.front().isFixed(v)) continue;
    const EditMesh::Vertex from = mesh.vertex(v);
    const Vec3 aim = smoothedPlace(morph, v);
    constexpr int kHalvings = 2;
    double step = 1.0;
    for (int i = 0; i <= kHalvings; ++i, step *= 0.5) {
      if (morph.front().tryMove(v, morph.place(from, from.position + (aim - from.position) * step), kLeastShape)) break;
    }
  }
  return order;
}

bool untangle(MorphMesh& morph, const std::vector<VertexId>& nodes, double least) {
  const EditMesh& mesh = morph.mesh();
  const std::vector<VertexId> order = withNeighbours(mesh, nodes);
  const auto good = [&] {
    return std::all_of(nodes.begin(), nodes.end(), [&](VertexId v) { return worstShapeAround(mesh, v) >= least; });
  };
  constexpr int kSweeps = 6;
  for (int sweep = 0; sweep < kSweeps && !good(); ++sweep) {
    for (const VertexId v : order) {
      if (morph.front().isFixed(v)) continue;
      improve(morph, v, weightedMean(mesh, v));
      const FrontNode node = lookAt(morph, v);
      if (node.quads > 0) improve(morph, v, node.parallelogram);
    }
  }
  return good();
}

}  // namespace qmcf
