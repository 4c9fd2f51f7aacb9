#include "singularities.hpp"

#include <cmath>

#include "qmcf/base/math.hpp"

namespace qmcf {

double crossTurn(const Surface& surface, const Connection& connection,
                 const IdMap<VertexId, std::complex<double>>& cross, HalfedgeId h) {
  const HalfedgeId back = surface.twin(h);
  // Measured once per edge, so that a half turn has opposite signs seen from the two sides.
  if (back.valid() && back < h) return -crossTurn(surface, connection, cross, back);
  const std::complex<double> moved = cross[surface.origin(h)] * transportCross(surface, connection, h);
  return math::arg(cross[surface.target(h)] * std::conj(moved));
}

std::int32_t triangleIndex(const Surface& surface, const Connection& connection,
                           const IdMap<VertexId, std::complex<double>>& cross, TriangleId t) {
  double turn = 4.0 * triangleCurvature(connection, t);
  for (int c = 0; c < 3; ++c) turn += crossTurn(surface, connection, cross, Surface::halfedge(t, c));
  return static_cast<std::int32_t>(std::floor(turn / (2.0 * math::kPi) + 0.5));
}

IdMap<TriangleId, std::int32_t> triangleIndices(const Surface& surface, const Connection& connection,
                                                const IdMap<VertexId, std::complex<double>>& cross) {
  IdMap<TriangleId, std::int32_t> index(surface.triangleCount(), 0);
  for (const TriangleId t : surface.triangles()) index[t] = triangleIndex(surface, connection, cross, t);
  return index;
}

std::array<double, 3> zeroOf(const std::array<std::complex<double>, 3>& corner) {
  const auto area = [](std::complex<double> a, std::complex<double> b) {
    return a.real() * b.imag() - a.imag() * b.real();
  };
  const double w0 = area(corner[1], corner[2]);
  const double w1 = area(corner[2], corner[0]);
  const double w2 = area(corner[0], corner[1]);
  const double sum = w0 + w1 + w2;
  const bool inside = (w0 > 0.0 && w1 > 0.0 && w2 > 0.0) || (w0 < 0.0 && w1 < 0.0 && w2 < 0.0);
  if (!inside) return {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
  return {w0 / sum, w1 / sum, w2 / sum};
}

std::vector<Singularity> locateSingularities(const CrossField& field) {
  std::vector<Singularity> result;
  for (const TriangleId t : IdRange<TriangleId>(field.index.size())) {
    if (field.index[t] != 0) result.push_back({{t, zeroOf(field.corner[t])}, field.index[t]});
  }
  return result;
}

std::int64_t gaussBonnetDefect(const Patch& patch, const CrossField& field) {
  const Surface& surface = patch.surface;
  const Connection connection = buildConnection(patch);
  std::int64_t defect = -4 * surface.eulerCharacteristic();
  for (const TriangleId t : surface.triangles()) defect += field.index[t];
  double turn = 0.0;
  for (const VertexId v : surface.vertices()) {
    if (surface.isBoundary(v)) defect += 2 - wantedQuads(patch, v, connection.fan[v]);
  }
  for (const HalfedgeId h : surface.halfedges()) {
    if (surface.isBoundary(h)) turn += crossTurn(surface, connection, field.cross, h);
  }
  return defect - static_cast<std::int64_t>(std::floor(turn / (2.0 * math::kPi) + 0.5));
}

}  // namespace qmcf
