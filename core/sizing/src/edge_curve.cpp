#include "qmcf/sizing/edge_curve.hpp"

#include <algorithm>
#include <cstddef>

namespace qmcf {
namespace {

struct Segment {
  std::size_t first;
  double fraction;
};

/// Where `at` lies between two entries of the ascending table x of at least two entries.
Segment locate(const std::vector<double>& x, double at) {
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  const auto first = static_cast<std::size_t>(above - x.begin()) - 1;
  const double width = x[first + 1] - x[first];
  return {first, width > 0.0 ? std::clamp((at - x[first]) / width, 0.0, 1.0) : 0.0};
}

}  // namespace

Vec3 EdgeCurve::at(double s) const {
  const auto [first, fraction] = locate(arcLength, s);
  return points[first] * (1.0 - fraction) + points[first + 1] * fraction;
}

EdgeCurve edgeCurve(const TriangleMesh& mesh, const BrepEdge& edge) {
  EdgeCurve curve;
  curve.closed = edge.start == edge.end;
  curve.points.reserve(edge.points.size());
  curve.arcLength.reserve(edge.points.size());
  double s = 0.0;
  for (const std::int32_t point : edge.points) {
    const Vec3& position = mesh.positions[static_cast<std::size_t>(point)];
    if (!curve.points.empty()) s += distance(curve.points.back(), position);
    curve.points.push_back(position);
    curve.arcLength.push_back(s);
  }
  return curve;
}

double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (x.size() < 2) return y.front();
  const auto [first, fraction] = locate(x, at);
  return y[first] * (1.0 - fraction) + y[first + 1] * fraction;
}

}  // namespace qmcf
