#include "qmcf/sizing/inner_sizes.hpp"

#include <algorithm>
#include <cmath>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

/// (ln b - ln a) / (b - a).
double logSlope(double a, double b) {
  constexpr double kNearlyEqual = 1e-4;
  if (std::fabs(b - a) <= kNearlyEqual * a) return 2.0 / (a + b);
  return math::log(b / a) / (b - a);
}

}  // namespace

double countInTriangle(const std::array<double, 3>& size, double area) {
  constexpr double kNearlyEqual = 1.5;
  std::array<double, 3> h = size;
  std::sort(h.begin(), h.end());
  if (h[2] <= kNearlyEqual * h[0]) {
    // At the middles of the sides: exact for polynomials of degree 2.
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double middle = 0.5 * (h[c] + h[(c + 1) % 3]);
      sum += 1.0 / (middle * middle);
    }
    return area * sum / 3.0;
  }
  // Hermite and Genocchi: twice the area times the second divided difference of -ln h, whose second derivative is
  // 1/h^2.
  return 2.0 * area * (logSlope(h[0], h[1]) - logSlope(h[1], h[2])) / (h[2] - h[0]);
}

double countOf(const InnerSizes& sizes) {
  double sum = 0.0;
  for (const auto& t : sizes.triangles) {
    const auto at = [&](std::size_t c) -> const Vec3& { return sizes.positions[static_cast<std::size_t>(t[c])]; };
    const auto of = [&](std::size_t c) { return sizes.value[static_cast<std::size_t>(t[c])]; };
    sum += countInTriangle({of(0), of(1), of(2)}, 0.5 * norm(cross(at(1) - at(0), at(2) - at(0))));
  }
  return sum;
}

}  // namespace qmcf
