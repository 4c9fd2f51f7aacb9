#include "qmcf/front/front_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "qmcf/base/math.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/spatial/surface_walk.hpp"

namespace qmcf {
namespace {

/// How strongly the number of quads in a sector is drawn to the one that makes the vertex regular.
constexpr double kRegularityBias = 0.35;
constexpr double kBoundaryBias = 0.6;

double cornerAngle(const EditMesh& mesh, HalfedgeId h) {
  const Vec3 p = mesh.position(mesh.origin(h));
  const Vec3 u = mesh.position(mesh.target(h)) - p;
  const Vec3 v = mesh.position(mesh.origin(mesh.prev(h))) - p;
  return math::atan2(norm(cross(u, v)), dot(u, v));
}

}  // namespace

FrontMesh::FrontMesh(const Patch& patch, const CrossField& field)
    : patch_(patch), field_(field), mesh_(patch.surface, patch.normal) {}

HalfedgeId FrontMesh::nextFront(HalfedgeId h) const {
  HalfedgeId n = mesh_.next(h);
  while (!isFront(n)) n = mesh_.next(mesh_.twin(n));
  return n;
}

HalfedgeId FrontMesh::previousFront(HalfedgeId h) const {
  HalfedgeId p = mesh_.prev(h);
  while (!isFront(p)) p = mesh_.prev(mesh_.twin(p));
  return p;
}

std::optional<int> FrontMesh::loopLength(HalfedgeId h, int limit) const {
  int length = 1;
  for (HalfedgeId e = nextFront(h); e != h; e = nextFront(e)) {
    if (++length > limit) return std::nullopt;
  }
  return length;
}

bool FrontMesh::turnsInward(HalfedgeId h) const {
  double turning = 0.0;
  HalfedgeId e = h;
  do {
    turning += math::kPi - sectorAngle(e);
    e = nextFront(e);
  } while (e != h);
  return turning > 0.0;
}

bool FrontMesh::isFree(VertexId v) const {
  if (mesh_.isBoundary(v)) return false;
  bool free = true;
  mesh_.forEachOutgoing(v, [&](HalfedgeId h) { free = free && mesh_.isOpen(h); });
  return free;
}

double FrontMesh::sectorAngle(HalfedgeId h) const {
  double angle = cornerAngle(mesh_, h);
  for (HalfedgeId e = mesh_.prev(h); !isFront(e); e = mesh_.prev(e)) {
    e = mesh_.twin(e);
    angle += cornerAngle(mesh_, e);
  }
  return angle;
}

FrontMesh::Surroundings FrontMesh::surroundings(VertexId v) const {
  Surroundings result;
  mesh_.forEachOutgoing(v, [&](HalfedgeId h) {
    if (!mesh_.isOpen(h)) ++result.elements;
    if (isFront(h)) ++result.sectors;
  });
  return result;
}

int FrontMesh::wantedQuads(HalfedgeId h) const {
  const VertexId v = mesh_.origin(h);
  const Surroundings around = surroundings(v);
  const double quarters = 2.0 * sectorAngle(h) / math::kPi;
  const bool boundary = mesh_.isBoundary(v);
  const int total = boundary ? patch_.cornerQuads[v] : 4;
  if (boundary && around.elements == 0 && around.sectors == 1) return total;
  if (around.sectors != 1) return static_cast<int>(std::floor(quarters + 0.5));
  const int missing = total - around.elements;
  const double bias = boundary ? kBoundaryBias : kRegularityBias;
  int best = 0;
  double bestCost = 0.0;
  for (int k = 0; k <= 4; ++k) {
    const double cost = std::fabs(k - quarters) + bias * std::abs(k - missing);
    if (k == 0 || cost < bestCost) {
      best = k;
      bestCost = cost;
    }
  }
  return best;
}

double FrontMesh::sizeAt(const SurfacePoint& point) const { return interpolate(patch_.surface, patch_.size, point); }

Vec3 FrontMesh::crossNear(const SurfacePoint& point, const Vec3& direction) const {
  const auto directions = crossDirections(patch_.surface, field_, point);
  Vec3 best = directions[0];
  for (const Vec3& d : directions) {
    if (dot(d, direction) > dot(best, direction)) best = d;
  }
  return best;
}

EditMesh::Vertex FrontMesh::vertexNear(const SurfacePoint& start, const Vec3& position) const {
  EditMesh::Vertex vertex;
  vertex.location = walkToClosest(patch_.surface, start.triangle, position);
  vertex.position = positionOf(patch_.surface, vertex.location);
  vertex.normal = normalized(interpolate(patch_.surface, patch_.normal, vertex.location));
  return vertex;
}

bool FrontMesh::tryMove(VertexId v, const EditMesh::Vertex& moved, double least) {
  const double before = worstShapeAround(mesh_, v);
  const std::size_t mark = mesh_.mark();
  mesh_.setVertex(v, moved);
  const double after = worstShapeAround(mesh_, v);
  if (after >= std::min(least, before) && after > 0.0) return true;
  mesh_.rollback(mark);
  return false;
}

LocalPlane planeBetween(const EditMesh& mesh, VertexId a, VertexId b) {
  const Vec3 sum = mesh.normal(a) + mesh.normal(b);
  return LocalPlane(mesh.position(a), squaredNorm(sum) > 1e-12 ? normalized(sum) : mesh.normal(a));
}

}  // namespace qmcf
