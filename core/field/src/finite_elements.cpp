// The matrices of Knoeppel, Crane, Pinkall and Schroeder, "Globally optimal direction fields", 2013, for fields of
// degree 4 (A2 of docs/algorithm.md). Curvature is spread evenly over each triangle, so that the field turns by omega =
// 4 K around it.
#include <cmath>
#include <vector>

#include "matrices.hpp"
#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

constexpr int kTerms = 24;  // of the series, enough for |omega| <= pi
const Complex kI(0.0, 1.0);

/// Mass of two corners per area: 1/12 where omega is 0.
Complex massFactor(double omega) {
  if (std::fabs(omega) > math::kPi) {
    const Complex turn = math::unitComplex(omega);
    const double o2 = omega * omega;
    return (6.0 * turn - 6.0 - 6.0 * kI * omega + 3.0 * o2 + kI * o2 * omega) / (3.0 * o2 * o2);
  }
  Complex sum = 0.0;
  Complex term = 2.0 / 24.0;
  for (int m = 0; m < kTerms; ++m) {
    sum += term;
    term *= kI * omega / static_cast<double>(m + 5);
  }
  return sum;
}

/// Energy of two corners times the area: -gij / 4 where omega is 0. g: products of the edges that leave the third
/// corner.
Complex energyFactor(double omega, double gii, double gij, double gjj) {
  const double p = 3.0 * gii + 4.0 * gij + 3.0 * gjj;
  const double q = 2.0 * gii + 3.0 * gij + 2.0 * gjj;
  const double r = gii + 2.0 * gij + gjj;
  const double n = gii - 2.0 * gij + gjj;
  const Complex linear(n / 24.0, -omega * n / 60.0);
  if (std::fabs(omega) > math::kPi) {
    const Complex turn = math::unitComplex(omega);
    const double o2 = omega * omega;
    const Complex sum =
        p + kI * omega * (gii + gij + gjj) - kI * o2 * omega * gij / 6.0 + turn * (-p + kI * omega * q + 0.5 * o2 * r);
    return sum / (o2 * o2) + linear;
  }
  Complex sum = 0.0;
  Complex power = 0.5;  // (i omega)^m / (m + 2)!
  for (int m = 0; m < kTerms; ++m) {
    const double m3 = m + 3;
    const double m4 = m + 4;
    sum += power * (-p / (m3 * m4) + q / m3 - 0.5 * r);
    power *= kI * omega / m3;
  }
  return sum + linear;
}

}  // namespace

FieldMatrices assembleFiniteElements(const Patch& patch, const Connection& connection, double smoothness) {
  const Surface& surface = patch.surface;
  const auto count = static_cast<Eigen::Index>(surface.vertexCount());
  FieldMatrices matrices = measuredMatrices(patch);
  std::vector<Eigen::Triplet<Complex>> energy;
  std::vector<Eigen::Triplet<Complex>> mass;
  energy.reserve(3 * surface.halfedgeCount());
  mass.reserve(3 * surface.halfedgeCount());
  for (const TriangleId t : surface.triangles()) {
    const double area = 0.5 * norm(surface.areaVector(t));
    if (!(area > 0.0)) continue;
    const double omega = 4.0 * triangleCurvature(connection, t);
    for (int c = 0; c < 3; ++c) {
      const HalfedgeId h = Surface::halfedge(t, c);
      const Vec3 pi = surface.position(surface.origin(h));
      const Vec3 pj = surface.position(surface.target(h));
      const Vec3 pk = surface.position(surface.opposite(h));
      const int i = surface.origin(h).value;
      const int j = surface.target(h).value;
      const double sides = squaredNorm(pj - pi) + dot(pj - pi, pk - pi) + squaredNorm(pk - pi);
      const double own = 0.25 * (squaredNorm(pk - pj) + omega * omega / 90.0 * sides) / area;
      energy.emplace_back(i, i, own - smoothness * omega / 6.0);
      mass.emplace_back(i, i, area / 6.0);

      const Complex move = std::conj(transportCross(surface, connection, h));
      const Complex massIj = area * move * massFactor(omega);
      const Complex energyIj =
          move * energyFactor(omega, squaredNorm(pi - pk), dot(pi - pk, pj - pk), squaredNorm(pj - pk)) / area -
          smoothness * (omega / area * massIj - 0.5 * kI * move);
      energy.emplace_back(i, j, energyIj);
      energy.emplace_back(j, i, std::conj(energyIj));
      mass.emplace_back(i, j, massIj);
      mass.emplace_back(j, i, std::conj(massIj));
    }
  }
  matrices.energy.resize(count, count);
  matrices.energy.setFromTriplets(energy.begin(), energy.end());
  matrices.mass.resize(count, count);
  matrices.mass.setFromTriplets(mass.begin(), mass.end());
  return matrices;
}

}  // namespace qmcf
