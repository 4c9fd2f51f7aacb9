#include "qmcf/field/connection.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

constexpr double kSmallestFan = 1e-9;

/// The directions of v's half-edges and the scaled angles between them.
void unrollFan(const Patch& patch, VertexId v, Connection& connection) {
  const Surface& surface = patch.surface;
  double fan = 0.0;
  int corners = 0;
  surface.forEachOutgoing(v, [&](HalfedgeId h) {
    fan += connection.corner[h];
    ++corners;
  });
  const double total = surface.isBoundary(v) ? 0.5 * math::kPi * wantedQuads(patch, v, fan) : 2.0 * math::kPi;
  double angle = 0.0;
  surface.forEachOutgoing(v, [&](HalfedgeId h) {
    const double part = fan > kSmallestFan ? connection.corner[h] / fan : 1.0 / corners;
    connection.angle[h] = angle;
    connection.scaled[h] = part * total;
    angle += connection.scaled[h];
  });
  connection.fan[v] = fan;
  connection.total[v] = total;
}

}  // namespace

std::int32_t wantedQuads(const Patch& patch, VertexId boundaryVertex, double fanAngle) {
  const std::int32_t given = patch.cornerQuads.empty() ? 0 : patch.cornerQuads[boundaryVertex];
  if (given > 0) return std::min(given, 4);
  return std::clamp(static_cast<std::int32_t>(std::floor(2.0 * fanAngle / math::kPi + 0.5)), 1, 4);
}

Connection buildConnection(const Patch& patch) {
  const Surface& surface = patch.surface;
  Connection connection;
  connection.corner.resize(surface.halfedgeCount());
  connection.scaled.resize(surface.halfedgeCount());
  connection.angle.resize(surface.halfedgeCount());
  connection.fan.resize(surface.vertexCount());
  connection.total.resize(surface.vertexCount());
  for (const HalfedgeId h : surface.halfedges()) connection.corner[h] = surface.angle(h);
  for (const VertexId v : surface.vertices()) unrollFan(patch, v, connection);
  return connection;
}

void followSizes(const Patch& patch, Connection& connection) {
  const Surface& surface = patch.surface;
  const auto& sizes = patch.size.raw();
  if (std::adjacent_find(sizes.begin(), sizes.end(), std::not_equal_to<>()) == sizes.end()) return;
  connection.growth.resize(surface.halfedgeCount(), 0.0);
  for (const TriangleId t : surface.triangles()) {
    const auto corners = surface.corners(t);
    const auto at = [&](std::size_t c) -> const Vec3& { return surface.position(corners[c % 3]); };
    const double twiceArea = norm(cross(at(1) - at(0), at(2) - at(0)));
    if (!(twiceArea > 0.0)) continue;
    // J grad(ln h): the gradient of the function that is 1 at a corner is the opposite side, turned inwards.
    Vec3 turn;
    for (std::size_t c = 1; c < 3; ++c) {
      turn += (at(c + 1) - at(c + 2)) * (math::log(patch.size[corners[c]] / patch.size[corners[0]]) / twiceArea);
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const HalfedgeId h = Surface::halfedge(t, static_cast<int>(c));
      const HalfedgeId back = surface.twin(h);
      if (!back.valid()) continue;
      // The mean of what the triangles on both sides say.
      const double half = 0.5 * dot(turn, at(c + 1) - at(c));
      connection.growth[h] += half;
      connection.growth[back] -= half;
    }
  }
}

double transportAngle(const Surface& surface, const Connection& connection, HalfedgeId h) {
  const HalfedgeId back = surface.twin(h);
  const double arrival = back.valid() ? connection.angle[back] : connection.total[surface.target(h)];
  const double turn = arrival - math::kPi - connection.angle[h];
  return connection.growth.empty() ? turn : turn + connection.growth[h];
}

std::complex<double> transportCross(const Surface& surface, const Connection& connection, HalfedgeId h) {
  const HalfedgeId back = surface.twin(h);
  if (!back.valid()) return 1.0;
  if (back < h) return std::conj(math::unitComplex(4.0 * transportAngle(surface, connection, back)));
  return math::unitComplex(4.0 * transportAngle(surface, connection, h));
}

double triangleCurvature(const Connection& connection, TriangleId t) {
  double turn = -math::kPi;
  for (int c = 0; c < 3; ++c) {
    const HalfedgeId h = Surface::halfedge(t, c);
    turn += connection.scaled[h];
    if (!connection.growth.empty()) turn += connection.growth[h];
  }
  return turn;
}

}  // namespace qmcf
