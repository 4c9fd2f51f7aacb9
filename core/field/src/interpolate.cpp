#include "interpolate.hpp"

#include <cmath>

#include "corner_frame.hpp"
#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

/// Whether the boundary runs smoothly through v: a discretised curve and no corner.
bool insideCurve(const Patch& patch, VertexId v, HalfedgeId first, HalfedgeId last, double total) {
  if (total != math::kPi || patch.edge.empty()) return false;
  const std::int32_t edge = patch.edge[first];
  return edge != kNone && edge == patch.edge[Surface::prev(last)] && !patch.cornerQuads.empty() &&
         patch.cornerQuads[v] == 2;
}

/// Unrolls the fan of v once more, without scaling, triangle by triangle: where the scaled and the plain angle of a
/// triangle's corner differ, they agree along a boundary edge, and in the middle of the corner elsewhere.
void fillFan(const Patch& patch, const Connection& connection, VertexId v, CrossField& field) {
  const Surface& surface = patch.surface;
  const HalfedgeId first = surface.outgoing(v);
  HalfedgeId last = first;
  surface.forEachOutgoing(v, [&](HalfedgeId h) { last = h; });
  const bool open = surface.isBoundary(v);
  const bool smooth = open && insideCurve(patch, v, first, last, connection.total[v]);
  double plain = 0.0;
  surface.forEachOutgoing(v, [&](HalfedgeId h) {
    double share = 0.5;
    if (open && first != last && h == first) share = 0.0;
    if (open && first != last && h == last) share = 1.0;
    const TriangleId t = Surface::triangle(h);
    const double turn = cornerTurn(connection, h, share);
    const auto corner = static_cast<std::size_t>(h.value % 3);
    field.corner[t][corner] = field.cross[v] * math::unitComplex(4.0 * turn);
    if (smooth) {
      // The tangent halves the deviation of the two chords; the chord itself is right halfway along it.
      const double tangent =
          directionInTriangle(connection, h) - plain + 0.5 * (connection.fan[v] - connection.total[v]);
      field.extraTurn[t][corner] = tangent - turn;
    }
    plain += connection.corner[h];
  });
}

/// What the field turns because elements grow is kept apart, too: linear in each triangle, and 0 in its middle.
void keepGrowthApart(const Connection& connection, TriangleId t, CrossField& field) {
  std::array<double, 3> growth{};
  for (std::size_t c = 0; c < 3; ++c) growth[c] = connection.growth[Surface::halfedge(t, static_cast<int>(c))];
  for (std::size_t c = 0; c < 3; ++c) {
    // What is left over around the triangle is spread evenly over its sides.
    const double turn = (growth[(c + 2) % 3] - growth[c]) / 3.0;
    field.corner[t][c] *= math::unitComplex(-4.0 * turn);
    field.extraTurn[t][c] += turn;
  }
}

std::complex<double> interpolated(const CrossField& field, const SurfacePoint& point) {
  const auto& corner = field.corner[point.triangle];
  return corner[0] * point.barycentric[0] + corner[1] * point.barycentric[1] + corner[2] * point.barycentric[2];
}

}  // namespace

void fillCorners(const Patch& patch, const Connection& connection, CrossField& field) {
  field.corner.resize(patch.surface.triangleCount());
  field.extraTurn.resize(patch.surface.triangleCount(), {0.0, 0.0, 0.0});
  for (const VertexId v : patch.surface.vertices()) fillFan(patch, connection, v, field);
  if (connection.growth.empty()) return;
  for (const TriangleId t : patch.surface.triangles()) keepGrowthApart(connection, t, field);
}

double crossAngle(const CrossField& field, const SurfacePoint& point) {
  std::complex<double> u = interpolated(field, point);
  if (std::norm(u) < 1e-24) u = field.corner[point.triangle][0];
  const auto& turn = field.extraTurn[point.triangle];
  return 0.25 * math::arg(u) + turn[0] * point.barycentric[0] + turn[1] * point.barycentric[1] +
         turn[2] * point.barycentric[2];
}

std::array<Vec3, 4> crossDirections(const Surface& surface, const CrossField& field, const SurfacePoint& point) {
  const auto [a, b, c] = surface.corners(point.triangle);
  const Vec3 x = normalized(surface.position(b) - surface.position(a));
  const Vec3 normal = normalized(surface.areaVector(point.triangle));
  const Vec3 y = cross(normal, x);
  const std::complex<double> direction = math::unitComplex(crossAngle(field, point));
  const Vec3 first = x * direction.real() + y * direction.imag();
  const Vec3 second = y * direction.real() - x * direction.imag();
  return {first, second, -first, -second};
}

double crossConfidence(const CrossField& field, const SurfacePoint& point) {
  return std::sqrt(std::norm(interpolated(field, point)));
}

}  // namespace qmcf
