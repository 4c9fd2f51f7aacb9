#include "stand.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "qmcf/base/math.hpp"
#include "qmcf/quality/turned_over.hpp"
#include "qmcf/spatial/surface_walk.hpp"

namespace qmcf {
namespace {

constexpr int kDirections = 12;
/// How far a vertex is moved, in element sizes.
constexpr std::array<double, 5> kSteps{0.08, 0.2, 0.4, 0.7, 1.1};
/// Cosine of the angle to the surface and scaled Jacobian that are as good as any here.
constexpr double kUpright = 0.15;
constexpr double kSquare = 0.15;
constexpr double kClearlyUpright = 0.85;

/// A triangle of the face near an element, if one is known.
std::int32_t facetNear(const EditMesh& mesh, const std::array<HalfedgeId, 4>& sides) {
  for (const HalfedgeId h : sides) {
    if (h.valid() && mesh.vertex(mesh.origin(h)).facet != kNone) return mesh.vertex(mesh.origin(h)).facet;
  }
  return kNone;
}

}  // namespace

Stand standOf(const EditMesh& mesh, const RelaxationTarget& target, FaceId f) {
  const auto sides = mesh.sides(f);
  const std::size_t corners = sides[3].valid() ? 4 : 3;
  const std::int32_t facet = facetNear(mesh, sides);
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
      if (!belowCentre) belowCentre = target.face.normal(target.face.closest(centre, facet).triangle);
      upright = dot(normal, *belowCentre);
    }
    if (upright < kUpright) {
      const Vec3 quarter = p(i) + (centre - p(i)) * 0.25;
      upright = std::max(upright, dot(normal, target.face.normal(target.face.closest(quarter, facet).triangle)));
    }
    stand.penalty += std::max(0.0, kUpright - upright);
    const double lengths = norm(forward) * norm(backward);
    const double square =
        corners == 4 && lengths > 0.0 ? dot(area, own) / lengths : norm(area) / std::max(lengths, 1e-300);
    stand.penalty += 2.0 * std::max(0.0, kSquare - square);
    stand.turnedOver = stand.turnedOver || upright <= 0.0 || square <= 0.0;
  }
  if (target.part == nullptr) return stand;
  std::array<Vec3, 4> places;
  for (std::size_t i = 0; i < corners; ++i) places[i] = p(i);
  const std::int32_t near = facet == kNone ? kNone : target.part->triangleOf[static_cast<std::size_t>(facet)];
  const TriangleBvh& part = target.part->tree;
  const double by = turnedOverBy(part, places, corners, part.closest(centre, near));
  stand.turnedOver = stand.turnedOver || by > 0.0;
  stand.penalty += by;
  return stand;
}

namespace {

/// The penalty of all elements of a vertex; once it is known to be as high as `most`, the rest is left out.
double penaltyAround(const EditMesh& mesh, const RelaxationTarget& target, VertexId v, double most) {
  double sum = 0.0;
  mesh.forEachOutgoing(v, [&](HalfedgeId h) {
    if (sum < most) sum += standOf(mesh, target, mesh.face(h)).penalty;
  });
  return sum;
}

}  // namespace

bool moveToBest(EditMesh& mesh, const RelaxationTarget& target, VertexId v) {
  constexpr double kWorthwhile = 0.98;
  const double before = penaltyAround(mesh, target, v, HUGE_VAL);
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
      const double penalty = penaltyAround(mesh, target, v, least);
      if (penalty >= least) continue;
      least = penalty;
      best = moved;
    }
  }
  const bool helps = least < kWorthwhile * before;
  mesh.setVertex(v, helps ? best : start);
  return helps;
}

Damage damageAround(const EditMesh& mesh, const RelaxationTarget& target, const std::vector<VertexId>& vertices) {
  std::vector<FaceId> faces;
  for (const VertexId v : vertices) {
    if (!mesh.alive(v)) continue;
    mesh.forEachOutgoing(v, [&](HalfedgeId h) { faces.push_back(mesh.face(h)); });
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  Damage damage;
  for (const FaceId f : faces) {
    const Stand stand = standOf(mesh, target, f);
    damage.turnedOver += stand.turnedOver ? 1 : 0;
    damage.penalty += stand.penalty;
  }
  return damage;
}

}  // namespace qmcf
