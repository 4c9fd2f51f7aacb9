#include "untangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "qmcf/base/math.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/spatial/surface_walk.hpp"

namespace qmcf {
namespace {

constexpr int kSweeps = 12;
/// From this sweep on the neighbours of the elements move too.
constexpr int kWiderSweep = 3;
constexpr int kDirections = 12;
/// How far a vertex is moved, in element sizes.
constexpr std::array<double, 5> kSteps{0.08, 0.2, 0.4, 0.7, 1.1};
/// Cosine of the angle to the surface and scaled Jacobian that are as good as any here.
constexpr double kUpright = 0.15;
constexpr double kSquare = 0.15;
constexpr double kClearlyUpright = 0.85;

/// How an element stands on the face.
struct Stand {
  bool turnedOver = false;
  double penalty = 0.0;  ///< 0 when every corner is upright and well shaped.
};

/// A corner is turned over when it faces against the surface both below itself and below the element's centre, or is
/// reflex.
Stand standOf(const EditMesh& mesh, const TriangleBvh& surface, FaceId f) {
  const auto sides = mesh.sides(f);
  const std::size_t corners = sides[3].valid() ? 4 : 3;
  const auto p = [&](std::size_t i) -> const Vec3& { return mesh.position(mesh.origin(sides[i % corners])); };
  Vec3 centre;
  for (std::size_t i = 0; i < corners; ++i) centre += p(i) / static_cast<double>(corners);
  std::optional<Vec3> belowCentre;
  const Vec3 own = corners == 4 ? normalized(cross(p(2) - p(0), p(3) - p(1))) : Vec3{};
  Stand stand;
  for (std::size_t i = 0; i < corners; ++i) {
    const Vec3 forward = p(i + 1) - p(i);
    const Vec3 backward = p(i + corners - 1) - p(i);
    const Vec3 area = cross(forward, backward);
    const Vec3 normal = normalized(area);
    // Mostly the smooth normal at the corner tells enough.
    double upright = dot(normal, mesh.normal(mesh.origin(sides[i])));
    if (upright < kClearlyUpright) {
      if (!belowCentre) belowCentre = surface.normal(surface.closest(centre).triangle);
      upright = dot(normal, *belowCentre);
    }
    if (upright < kUpright) {
      const Vec3 quarter = p(i) + (centre - p(i)) * 0.25;
      upright = std::max(upright, dot(normal, surface.normal(surface.closest(quarter).triangle)));
    }
    stand.penalty += std::max(0.0, kUpright - upright);
    const double lengths = norm(forward) * norm(backward);
    const double square =
        corners == 4 && lengths > 0.0 ? dot(area, own) / lengths : norm(area) / std::max(lengths, 1e-300);
    stand.penalty += 2.0 * std::max(0.0, kSquare - square);
    stand.turnedOver = stand.turnedOver || upright <= 0.0 || square <= 0.0;
  }
  return stand;
}

/// The penalty of all elements of a vertex; once it is known to be as high as `most`, the rest is left out.
double penaltyAround(const EditMesh& mesh, const TriangleBvh& surface, VertexId v, double most) {
  double sum = 0.0;
  mesh.forEachOutgoing(v, [&](HalfedgeId h) {
    if (sum < most) sum += standOf(mesh, surface, mesh.face(h)).penalty;
  });
  return sum;
}

/// Moves the vertex to the best of the places around it. Returns whether that helped.
bool moveToBest(EditMesh& mesh, const RelaxationTarget& target, VertexId v) {
  constexpr double kWorthwhile = 0.98;
  const double before = penaltyAround(mesh, target.face, v, HUGE_VAL);
  if (!(before > 0.0)) return false;
  const EditMesh::Vertex start = mesh.vertex(v);
  const double size = target.sizeScale * interpolate(target.patch.surface, target.patch.size, start.location);
  const Vec3 side = mesh.position(mesh.target(mesh.outgoing(v))) - start.position;
  const Vec3 x = normalized(tangentPart(side, start.normal));
  const Vec3 y = cross(start.normal, x);
  EditMesh::Vertex best = start;
  double least = before;
  for (const double step : kSteps) {
    for (int k = 0; k < kDirections; ++k) {
      const auto turn = math::unitComplex(2.0 * math::kPi * k / kDirections);
      const Vec3 aim = start.position + (x * turn.real() + y * turn.imag()) * (step * size);
      const EditMesh::Vertex moved = projectVertex(target, start, aim);
      mesh.setVertex(v, moved);
      const double penalty = penaltyAround(mesh, target.face, v, least);
      if (penalty >= least) continue;
      least = penalty;
      best = moved;
    }
  }
  const bool helps = least < kWorthwhile * before;
  mesh.setVertex(v, helps ? best : start);
  return helps;
}

/// Elements around some vertices that are turned over, and their penalty.
struct Damage {
  int turnedOver = 0;
  double penalty = 0.0;

  friend bool operator<(const Damage& a, const Damage& b) {
    return a.turnedOver != b.turnedOver ? a.turnedOver < b.turnedOver : a.penalty < b.penalty;
  }
};

Damage damageAround(const EditMesh& mesh, const TriangleBvh& surface, const std::vector<VertexId>& vertices) {
  std::vector<FaceId> faces;
  for (const VertexId v : vertices) {
    if (!mesh.alive(v)) continue;
    mesh.forEachOutgoing(v, [&](HalfedgeId h) { faces.push_back(mesh.face(h)); });
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  Damage damage;
  for (const FaceId f : faces) {
    const Stand stand = standOf(mesh, surface, f);
    damage.turnedOver += stand.turnedOver ? 1 : 0;
    damage.penalty += stand.penalty;
  }
  return damage;
}

/// The ways to change the two triangles beside an edge. Each returns whether it could be done.
bool joinTriangles(EditMesh& mesh, HalfedgeId h) {
  const HalfedgeId t = mesh.twin(h);
  mesh.fill({mesh.next(h), mesh.prev(h), mesh.next(t), mesh.prev(t)}, {mesh.face(h), mesh.face(t)}, FaceKind::element);
  return true;
}

bool turnDiagonal(EditMesh& mesh, HalfedgeId h) {
  const HalfedgeId t = mesh.twin(h);
  const HalfedgeId from = mesh.prev(h);
  const HalfedgeId to = mesh.prev(t);
  if (mesh.connected(mesh.origin(from), mesh.origin(to))) return false;
  joinTriangles(mesh, h);
  mesh.cut(from, to);
  return true;
}

bool contractEdge(EditMesh& mesh, HalfedgeId h) {
  if (mesh.isBoundary(mesh.target(h)) || !mesh.canCollapse(h)) return false;
  mesh.collapse(h);
  return true;
}

bool contractTwin(EditMesh& mesh, HalfedgeId h) { return contractEdge(mesh, mesh.twin(h)); }

/// Changes the two triangles beside h in the way that turns most elements back. Returns whether one does.
bool mendPair(EditMesh& mesh, const TriangleBvh& surface, HalfedgeId h) {
  using Change = bool (*)(EditMesh&, HalfedgeId);
  constexpr std::array<Change, 4> kChanges{turnDiagonal, joinTriangles, contractEdge, contractTwin};
  const HalfedgeId t = mesh.twin(h);
  const std::vector<VertexId> around{mesh.origin(h), mesh.target(h), mesh.origin(mesh.prev(h)),
                                     mesh.origin(mesh.prev(t))};
  Damage least = damageAround(mesh, surface, around);
  const int before = least.turnedOver;
  Change best = nullptr;
  for (const Change change : kChanges) {
    const std::size_t mark = mesh.mark();
    if (change(mesh, h)) {
      const Damage damage = damageAround(mesh, surface, around);
      if (damage.turnedOver < before && damage < least) {
        least = damage;
        best = change;
      }
    }
    mesh.rollback(mark);
  }
  return best != nullptr && best(mesh, h);
}

/// Where moving vertices has not helped, pairs of triangles are changed.
bool mendTriangles(EditMesh& mesh, const TriangleBvh& surface) {
  bool helped = false;
  for (std::size_t i = 0; i < mesh.faceCapacity(); ++i) {
    const FaceId f(i);
    if (mesh.kind(f) == FaceKind::removed || mesh.cornerCount(f) != 3 || !standOf(mesh, surface, f).turnedOver)
      continue;
    for (const HalfedgeId h : mesh.sides(f)) {
      if (!h.valid() || !mesh.twin(h).valid() || mesh.cornerCount(mesh.face(mesh.twin(h))) != 3) continue;
      if (!mendPair(mesh, surface, h)) continue;
      helped = true;
      break;
    }
  }
  mesh.commit();
  return helped;
}

}  // namespace

std::int64_t untangle(EditMesh& mesh, const RelaxationTarget& target) {
  std::int64_t found = 0;
  std::int64_t before = 0;  // Elements turned over, one sweep and two sweeps ago.
  std::int64_t earlier = 0;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    std::int64_t turnedOver = 0;
    std::vector<VertexId> vertices;  // Of these elements.
    for (std::size_t i = 0; i < mesh.faceCapacity(); ++i) {
      const FaceId f(i);
      if (mesh.kind(f) == FaceKind::removed || !standOf(mesh, target.face, f).turnedOver) continue;
      ++turnedOver;
      for (const HalfedgeId h : mesh.sides(f)) {
        if (!h.valid()) continue;
        vertices.push_back(mesh.origin(h));
        if (sweep < kWiderSweep) continue;
        mesh.forEachOutgoing(mesh.origin(h), [&](HalfedgeId out) { vertices.push_back(mesh.target(out)); });
      }
    }
    if (sweep == 0) found = turnedOver;
    // What two sweeps with all there is have not turned back will not be.
    if (vertices.empty() || (sweep > kWiderSweep + 1 && turnedOver >= earlier)) break;
    earlier = std::exchange(before, turnedOver);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    bool helped = false;
    for (const VertexId v : vertices) {
      if (!mesh.isBoundary(v)) helped = moveToBest(mesh, target, v) || helped;
    }
    mesh.commit();
    if (sweep < kWiderSweep) continue;
    helped = mendTriangles(mesh, target.face) || helped;
    if (!helped) break;
  }
  return found;
}

}  // namespace qmcf
