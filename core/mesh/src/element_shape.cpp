#include "qmcf/mesh/element_shape.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace qmcf {
namespace {

/// A corner that leans away from the surface by more than about 65 degrees counts as bad, by more than about 80 as
/// turned over: the input's facets there may lean still more.
constexpr double kLeaning = 0.4;
constexpr double kFolded = 0.2;
/// Height over length below which a triangle has no area to speak of, and sine of a corner's angle below which a quad
/// is no better: what is written as text may be turned over when it is read.
constexpr double kFlat = 1e-9;
/// What is better than asked for by this factor, in squares, is so whatever the round-off.
constexpr double kMargin = 1.01;

/// What makes an element costly, by the smallest sine at its corners. Triangles cost as much as four poor
/// quadrilaterals, but less than one with a corner that no solver likes.
constexpr double kPoor = 0.4;
constexpr double kVeryPoor = 0.12;
constexpr double kPoorCost = 1.0;
constexpr double kVeryPoorCost = 3.0;
constexpr double kTriangleCost = 4.0;
/// A quadrilateral with a sharper corner than this sine is of no use, even if the outline is to blame.
constexpr double kUsable = 0.1;

/// Whether a vector leans less than kLeaning from a unit normal, by a margin; without a square root, since nearly all
/// do.
bool isClearlyUpright(const Vec3& v, const Vec3& normal) {
  const double along = dot(v, normal);
  return along > 0.0 && along * along > kMargin * kLeaning * kLeaning * squaredNorm(v);
}

/// Whether a quad's shape is at least `least` by a margin. No square roots, no divisions.
bool isClearlyWellShaped(const std::array<const EditMesh::Vertex*, 4>& corners, double least) {
  const auto p = [&](std::size_t i) -> const Vec3& { return corners[i]->position; };
  const std::array<Vec3, 4> side{p(1) - p(0), p(2) - p(1), p(3) - p(2), p(0) - p(3)};
  const std::array<double, 4> square{squaredNorm(side[0]), squaredNorm(side[1]), squaredNorm(side[2]),
                                     squaredNorm(side[3])};
  const Vec3 normal = cross(p(2) - p(0), p(3) - p(1));
  const double enough = kMargin * least * least * squaredNorm(normal);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t before = (i + 3) % 4;
    const Vec3 corner = cross(side[before], side[i]);
    const double along = dot(corner, normal);
    if (!(along > 0.0) || !(along * along > enough * square[i] * square[before])) return false;
    if (!isClearlyUpright(corner, corners[i]->normal)) return false;
  }
  return true;
}

}  // namespace

double quadShape(const EditMesh& mesh, const std::array<VertexId, 4>& corners) {
  const auto p = [&](std::size_t i) -> const Vec3& { return mesh.position(corners[i % 4]); };
  const std::array<Vec3, 4> side{p(1) - p(0), p(2) - p(1), p(3) - p(2), p(0) - p(3)};
  const std::array<double, 4> length{norm(side[0]), norm(side[1]), norm(side[2]), norm(side[3])};
  const Vec3 normal = normalized(cross(p(2) - p(0), p(3) - p(1)));
  double worst = 1.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double lengths = length[i] * length[(i + 3) % 4];
    if (!(lengths > 0.0)) return -1.0;
    const Vec3 corner = cross(side[i], -side[(i + 3) % 4]) / lengths;
    // Against the element's own normal the scaled Jacobian; against the surface's a fold shows.
    worst = std::min(worst, dot(corner, normal));
    const Vec3& surface = mesh.normal(corners[i]);
    if (isClearlyUpright(corner, surface)) continue;
    const double upright = dot(normalized(corner), surface);
    if (upright < kLeaning) worst = std::min(worst, upright - kFolded);
  }
  return worst;
}

double triangleShape(const EditMesh& mesh, VertexId a, VertexId b, VertexId c) {
  const Vec3 ab = mesh.position(b) - mesh.position(a);
  const Vec3 bc = mesh.position(c) - mesh.position(b);
  const Vec3 ca = mesh.position(a) - mesh.position(c);
  const double squares = squaredNorm(ab) + squaredNorm(bc) + squaredNorm(ca);
  if (!(squares > 0.0)) return -1.0;
  const Vec3 normal = normalized(mesh.normal(a) + mesh.normal(b) + mesh.normal(c));
  constexpr double kEquilateral = 3.4641016151377544;  // 2 sqrt(3)
  return kEquilateral * dot(cross(ab, -ca), normal) / squares;
}

double faceShape(const EditMesh& mesh, FaceId f) {
  const auto sides = mesh.sides(f);
  const VertexId a = mesh.origin(sides[0]);
  const VertexId b = mesh.origin(sides[1]);
  const VertexId c = mesh.origin(sides[2]);
  return sides[3].valid() ? quadShape(mesh, {a, b, c, mesh.origin(sides[3])}) : triangleShape(mesh, a, b, c);
}

bool isInverted(const EditMesh& mesh, FaceId f) {
  const auto sides = mesh.sides(f);
  if (!sides[3].valid()) return !(faceShape(mesh, f) > 0.0);
  const auto p = [&](std::size_t i) -> const Vec3& { return mesh.position(mesh.origin(sides[i % 4])); };
  const Vec3 normal = cross(p(2) - p(0), p(3) - p(1));
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 corner = cross(p(i + 1) - p(i), p(i + 3) - p(i));
    if (!(dot(corner, normal) > 0.0) || !(dot(corner, mesh.normal(mesh.origin(sides[i]))) > 0.0)) return true;
  }
  return false;
}

bool isDegenerate(const EditMesh& mesh, FaceId f) {
  const auto sides = mesh.sides(f);
  const std::size_t corners = sides[3].valid() ? 4 : 3;
  const auto p = [&](std::size_t i) -> const Vec3& { return mesh.position(mesh.origin(sides[i % corners])); };
  const Vec3 normal = corners == 4 ? cross(p(2) - p(0), p(3) - p(1)) : cross(p(1) - p(0), p(2) - p(0));
  if (corners == 3) return !(norm(normal) > kFlat * squaredNorm(p(1) - p(0)));
  for (std::size_t i = 0; i < corners; ++i) {
    const Vec3 next = p(i + 1) - p(i);
    const Vec3 last = p(i + 3) - p(i);
    if (!(dot(cross(next, last), normal) > kFlat * norm(next) * norm(last) * norm(normal))) return true;
  }
  return false;
}

double worstShapeAround(const EditMesh& mesh, VertexId v) {
  double worst = 1.0;
  mesh.forEachOutgoing(v, [&](HalfedgeId h) { worst = std::min(worst, faceShape(mesh, mesh.face(h))); });
  return worst;
}

double worstSquareAround(const EditMesh& mesh, VertexId v) {
  constexpr double kEnough = 0.3;
  double worst = kEnough;
  mesh.forEachOutgoing(v, [&](HalfedgeId h) {
    const auto sides = mesh.sides(mesh.face(h));
    if (!sides[3].valid()) return;
    const auto p = [&](std::size_t i) -> const Vec3& { return mesh.position(mesh.origin(sides[i % 4])); };
    const Vec3 normal = normalized(cross(p(2) - p(0), p(3) - p(1)));
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 next = p(i + 1) - p(i);
      const Vec3 last = p(i + 3) - p(i);
      const double lengths = norm(next) * norm(last);
      worst = std::min(worst, lengths > 0.0 ? dot(cross(next, last), normal) / lengths : -1.0);
    }
  });
  return worst;
}

bool isWellShapedAround(const EditMesh& mesh, VertexId v, double least) {
  const auto corner = [&mesh](HalfedgeId h) { return &mesh.vertex(mesh.origin(h)); };
  const HalfedgeId first = mesh.outgoing(v);
  HalfedgeId h = first;
  do {
    const HalfedgeId last = mesh.prev(h);
    const HalfedgeId second = mesh.next(h);
    const HalfedgeId third = mesh.next(second);
    const bool isClear =
        third != last && isClearlyWellShaped({&mesh.vertex(v), corner(second), corner(third), corner(last)}, least);
    if (!isClear && !(faceShape(mesh, mesh.face(h)) >= least)) return false;
    h = mesh.twin(last);
  } while (h.valid() && h != first);
  return true;
}

double elementShape(const FaceMesh& mesh, const Element& element, const std::array<bool, 4>& fills) {
  const std::size_t n = cornerCount(element);
  Vec3 sum;
  for (std::size_t c = 0; c < n; ++c) sum += mesh.normals[static_cast<std::size_t>(element[c])];
  const Vec3 normal = normalized(sum);
  double worst = 1.0;
  for (std::size_t c = 0; c < n; ++c) {
    const auto corner = [&](std::size_t i) -> const Vec3& {
      return mesh.positions[static_cast<std::size_t>(element[i % n])];
    };
    const Vec3 ahead = corner(c + 1) - corner(c);
    const Vec3 back = corner(c + n - 1) - corner(c);
    const double lengths = norm(ahead) * norm(back);
    if (!(lengths > 0.0)) return -1.0;
    const double sine = dot(cross(ahead, back), normal) / lengths;
    if (fills[c] && sine > 0.0 && dot(ahead, back) > 0.0) {
      if (n == 4 && sine < kUsable) return -1.0;
      continue;
    }
    worst = std::min(worst, sine);
  }
  return worst;
}

double shapeCost(double shape, bool isTriangle) {
  const double square = (1.0 - shape) * (1.0 - shape);
  double cost = square * square;
  if (shape < kPoor) cost += kPoorCost;
  if (shape < kVeryPoor) cost += kVeryPoorCost;
  return isTriangle ? cost + kTriangleCost : cost;
}

double shapeCost(const FaceMesh& mesh) {
  std::vector<std::int32_t> elements(mesh.positions.size(), 0);
  for (const Element& element : mesh.elements) {
    for (std::size_t c = 0; c < cornerCount(element); ++c) ++elements[static_cast<std::size_t>(element[c])];
  }
  double cost = 0.0;
  for (const Element& element : mesh.elements) {
    std::array<bool, 4> fills{};
    for (std::size_t c = 0; c < cornerCount(element); ++c) {
      const auto v = static_cast<std::size_t>(element[c]);
      fills[c] = mesh.patchVertex[v] != kNone && elements[v] == 1;
    }
    cost += shapeCost(elementShape(mesh, element, fills), cornerCount(element) == 3);
  }
  return cost;
}

}  // namespace qmcf
