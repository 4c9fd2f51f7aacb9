#include "qmcf/field/connection.hpp"

#include <algorithm>
#include <cmath>

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

double transportAngle(const Surface& surface, const Connection& connection, HalfedgeId h) {
  const HalfedgeId back = surface.twin(h);
  const double arrival = back.valid() ? connection.angle[back] : connection.total[surface.target(h)];
  return arrival - math::kPi - connection.angle[h];
}

std::complex<double> transportCross(const Surface& surface, const Connection& connection, HalfedgeId h) {
  const HalfedgeId back = surface.twin(h);
  if (!back.valid()) return 1.0;
  if (back < h) return std::conj(math::unitComplex(4.0 * transportAngle(surface, connection, back)));
  return math::unitComplex(4.0 * transportAngle(surface, connection, h));
}

double triangleCurvature(const Connection& connection, TriangleId t) {
  return connection.scaled[Surface::halfedge(t, 0)] + connection.scaled[Surface::halfedge(t, 1)] +
         connection.scaled[Surface::halfedge(t, 2)] - math::kPi;
}

}  // namespace qmcf
