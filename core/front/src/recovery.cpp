// Walking, insertion and edge recovery in the working triangulation: steps 4a and 4b of section 4.1 (Owen et al. 1999).
#include "qmcf/front/recovery.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "qmcf/mesh/element_shape.hpp"

namespace qmcf {
namespace {

constexpr int kMaxWalk = 500;
constexpr int kMaxSwaps = 400;
/// Relative area below which a triangle counts as degenerate.
constexpr double kFlat = 1e-7;

Vec2 at(const EditMesh& mesh, const LocalPlane& plane, VertexId v) { return plane.point(mesh.position(v)); }

/// The first open triangle that the ray from the sector's vertex towards p enters, as the half-edge leaving the vertex.
HalfedgeId entryOfSector(const FrontMesh& front, HalfedgeId sector, Vec2 p, const LocalPlane& plane) {
  const EditMesh& mesh = front.mesh();
  const Vec2 a = at(mesh, plane, mesh.origin(sector));
  HalfedgeId h = sector;
  for (int step = 0; step < kMaxWalk; ++step) {
    const Vec2 u = at(mesh, plane, mesh.target(h));
    const Vec2 v = at(mesh, plane, mesh.origin(mesh.prev(h)));
    if (orient(a, u, p) >= 0.0 && orient(a, v, p) < 0.0 && dot(u + v - a - a, p - a) > 0.0) return h;
    const HalfedgeId back = mesh.prev(h);
    if (front.isFront(back)) break;
    h = mesh.twin(back);
  }
  return {};
}

/// Fraction of the way from a to p at which the line meets the edge from u to v.
double crossingFraction(Vec2 a, Vec2 p, Vec2 u, Vec2 v) {
  const double toward = cross(p - a, v - u);
  return std::fabs(toward) > 0.0 ? std::clamp(cross(u - a, v - u) / toward, 0.0, 1.0) : 1.0;
}

bool crosses(const EditMesh& mesh, const LocalPlane& plane, HalfedgeId h, VertexId a, VertexId b) {
  const VertexId u = mesh.origin(h);
  const VertexId v = mesh.target(h);
  if (u == a || u == b || v == a || v == b) return false;
  const Vec2 pa = at(mesh, plane, a);
  const Vec2 pb = at(mesh, plane, b);
  const Vec2 pu = at(mesh, plane, u);
  const Vec2 pv = at(mesh, plane, v);
  return (orient(pa, pb, pu) > 0.0) != (orient(pa, pb, pv) > 0.0) &&
         (orient(pu, pv, pa) > 0.0) != (orient(pu, pv, pb) > 0.0);
}

/// The edges that the segment from the sector's vertex to target crosses, in order; empty if a front is in the way.
std::vector<HalfedgeId> crossedEdges(const FrontMesh& front, HalfedgeId sector, VertexId target,
                                     const LocalPlane& plane) {
  const EditMesh& mesh = front.mesh();
  const Vec2 a = at(mesh, plane, mesh.origin(sector));
  const Vec2 p = at(mesh, plane, target);
  std::vector<HalfedgeId> crossed;
  const HalfedgeId entry = entryOfSector(front, sector, p, plane);
  if (!entry.valid()) return crossed;
  HalfedgeId edge = mesh.next(entry);
  for (int step = 0; step < kMaxWalk; ++step) {
    const HalfedgeId t = mesh.twin(edge);
    if (front.isFront(edge)) return {};
    crossed.push_back(edge);
    const VertexId w = mesh.origin(mesh.prev(t));
    if (w == target) return crossed;
    edge = orient(a, p, at(mesh, plane, w)) > 0.0 ? mesh.next(t) : mesh.prev(t);
  }
  return {};
}

HalfedgeId spokeTo(const FrontMesh& front, HalfedgeId sector, VertexId target) {
  const EditMesh& mesh = front.mesh();
  HalfedgeId h = sector;
  for (int step = 0; step < kMaxWalk; ++step) {
    if (mesh.target(h) == target) return h;
    const HalfedgeId back = mesh.prev(h);
    if (mesh.origin(back) == target) return mesh.twin(back).valid() ? mesh.twin(back) : HalfedgeId();
    if (front.isFront(back)) return {};
    h = mesh.twin(back);
  }
  return {};
}

}  // namespace

bool canSwap(const FrontMesh& front, HalfedgeId h) {
  const EditMesh& mesh = front.mesh();
  const HalfedgeId t = mesh.twin(h);
  if (!t.valid() || !mesh.isOpen(h) || !mesh.isOpen(t)) return false;
  const VertexId a = mesh.origin(h);
  const VertexId b = mesh.origin(t);
  const VertexId c = mesh.origin(mesh.prev(h));
  const VertexId d = mesh.origin(mesh.prev(t));
  if (c == d || mesh.connected(c, d)) return false;
  const Vec3 normal = normalized(mesh.normal(a) + mesh.normal(b) + mesh.normal(c) + mesh.normal(d));
  const Vec3& pa = mesh.position(a);
  const Vec3& pb = mesh.position(b);
  const Vec3& pc = mesh.position(c);
  const Vec3& pd = mesh.position(d);
  const double flat = kFlat * (squaredNorm(pd - pc) + squaredNorm(pb - pa));
  return orient(pd, pc, pa, normal) > flat && orient(pc, pd, pb, normal) > flat;
}

WalkResult walkTowards(const FrontMesh& front, HalfedgeId sector, const Vec3& target, const LocalPlane& plane) {
  const EditMesh& mesh = front.mesh();
  const Vec2 a = at(mesh, plane, mesh.origin(sector));
  const Vec2 p = plane.point(target);
  const HalfedgeId entry = entryOfSector(front, sector, p, plane);
  if (!entry.valid()) return {};
  HalfedgeId edge = mesh.next(entry);
  for (int step = 0; step < kMaxWalk; ++step) {
    const Vec2 u = at(mesh, plane, mesh.origin(edge));
    const Vec2 v = at(mesh, plane, mesh.target(edge));
    if (orient(u, v, p) >= 0.0) return {WalkResult::End::inside, mesh.face(edge), {}, 1.0};
    if (front.isFront(edge)) return {WalkResult::End::blocked, {}, edge, crossingFraction(a, p, u, v)};
    const HalfedgeId t = mesh.twin(edge);
    const Vec2 w = at(mesh, plane, mesh.origin(mesh.prev(t)));
    // Beyond the horizon, as seen along the plane's normal, the way can't be told any more.
    if (!(orient(v, u, w) > 0.0)) return {};
    edge = orient(a, p, w) > 0.0 ? mesh.next(t) : mesh.prev(t);
  }
  return {};
}

HalfedgeId recoverEdge(FrontMesh& front, HalfedgeId sector, VertexId target) {
  const EditMesh& view = front.mesh();
  const HalfedgeId existing = spokeTo(front, sector, target);
  if (existing.valid()) return existing;
  const VertexId a = view.origin(sector);
  if (view.connected(a, target)) return {};
  const LocalPlane plane = planeBetween(view, a, target);
  const std::vector<HalfedgeId> crossed = crossedEdges(front, sector, target, plane);
  std::deque<HalfedgeId> queue(crossed.begin(), crossed.end());
  std::size_t deferred = 0;
  for (int swaps = 0; !queue.empty() && deferred <= queue.size() && swaps < kMaxSwaps; ++swaps) {
    const HalfedgeId h = queue.front();
    queue.pop_front();
    if (!canSwap(front, h)) {
      queue.push_back(h);
      ++deferred;
      continue;
    }
    front.mesh().flip(h);
    if (crosses(view, plane, h, a, target)) {
      queue.push_back(h);
      ++deferred;
    } else {
      deferred = 0;
    }
  }
  return queue.empty() ? spokeTo(front, sector, target) : HalfedgeId();
}

VertexId insertInFace(FrontMesh& front, FaceId face, const EditMesh::Vertex& vertex, double reuse) {
  EditMesh& mesh = front.mesh();
  const HalfedgeId first = mesh.halfedge(face);
  const std::array<HalfedgeId, 3> sides{first, mesh.next(first), mesh.prev(first)};
  // A free vertex close by moves here, which keeps the triangulation as coarse as it was.
  VertexId nearest;
  double nearestDistance = reuse;
  for (const HalfedgeId h : sides) {
    const VertexId v = mesh.origin(h);
    const double d = distance(mesh.position(v), vertex.position);
    if (d < nearestDistance && front.isFree(v)) {
      nearest = v;
      nearestDistance = d;
    }
  }
  constexpr double kLeastAfterMove = 0.05;
  if (nearest.valid() && front.tryMove(nearest, vertex, kLeastAfterMove)) return nearest;

  std::array<double, 3> area{};
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    area[i] = orient(mesh.position(mesh.origin(sides[i])), mesh.position(mesh.target(sides[i])), vertex.position,
                     vertex.normal);
    sum += area[i];
  }
  if (!(sum > 0.0)) return {};
  constexpr double kNearEdge = 0.1;
  const auto least = static_cast<std::size_t>(std::min_element(area.begin(), area.end()) - area.begin());
  if (area[least] < kNearEdge * sum) {
    const HalfedgeId h = sides[least];
    if (front.isFront(h)) return {};
    const VertexId v = mesh.splitEdge(h, vertex);
    double worst = 1.0;
    mesh.forEachOutgoing(v, [&](HalfedgeId out) { worst = std::min(worst, faceShape(mesh, mesh.face(out))); });
    return worst > kFlat ? v : VertexId();
  }
  return mesh.splitTriangle(face, vertex);
}

VertexId insertVertex(FrontMesh& front, HalfedgeId sector, const EditMesh::Vertex& vertex, double reuse) {
  const EditMesh& mesh = front.mesh();
  const VertexId a = mesh.origin(sector);
  const LocalPlane plane(mesh.position(a), normalized(mesh.normal(a) + vertex.normal));
  const WalkResult walk = walkTowards(front, sector, vertex.position, plane);
  if (walk.end != WalkResult::End::inside) return {};
  return insertInFace(front, walk.face, vertex, reuse);
}

void makeDelaunay(FrontMesh& front, const std::vector<VertexId>& around) {
  EditMesh& mesh = front.mesh();
  std::vector<HalfedgeId> queue;
  for (const VertexId v : around) {
    if (!mesh.alive(v)) continue;
    mesh.forEachOutgoing(v, [&](HalfedgeId h) {
      if (!mesh.isOpen(h)) return;
      queue.push_back(h);
      queue.push_back(mesh.next(h));
    });
  }
  for (std::size_t step = 0; step < queue.size() && step < kMaxSwaps; ++step) {
    const HalfedgeId h = queue[step];
    if (!mesh.alive(h) || !mesh.isOpen(h) || front.isFront(h)) continue;
    const HalfedgeId t = mesh.twin(h);
    const Vec3 a = mesh.position(mesh.origin(h));
    const Vec3 b = mesh.position(mesh.target(h));
    const Vec3 c = mesh.position(mesh.origin(mesh.prev(h)));
    const Vec3 d = mesh.position(mesh.origin(mesh.prev(t)));
    // Delaunay: the angles opposite the edge sum to at most pi, that is sin(gamma + delta) >= 0.
    const double sinC = norm(cross(a - c, b - c));
    const double sinD = norm(cross(a - d, b - d));
    const double delaunay = sinC * dot(a - d, b - d) + sinD * dot(a - c, b - c);
    if (delaunay >= -1e-9 * sinC * sinD || !canSwap(front, h)) continue;
    const std::array<HalfedgeId, 4> sides{mesh.next(h), mesh.prev(h), mesh.next(t), mesh.prev(t)};
    mesh.flip(h);
    for (const HalfedgeId side : sides) queue.push_back(side);
  }
}

}  // namespace qmcf
