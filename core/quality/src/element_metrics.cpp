// Shape metrics of quadrilaterals and triangles. Scaled Jacobian and edge ratio as in the Verdict library (Stimpson et
// al. 2007); Jacobian ratio, aspect ratio and orthogonal quality as described in the ANSYS Meshing guide.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "qmcf/base/math.hpp"
#include "qmcf/quality/quality.hpp"

namespace qmcf {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDegrees = 180.0 / math::kPi;
constexpr std::size_t kCorners = 4;

/// What the metrics of one quadrilateral are made of.
struct QuadFrame {
  std::array<Vec3, kCorners> corner;
  std::array<Vec3, kCorners> edge;          ///< From corner i to corner i + 1.
  std::array<double, kCorners> length{};    ///< Of edge i.
  std::array<double, kCorners> jacobian{};  ///< Signed area of the parallelogram at corner i, in the mean plane.
  Vec3 normal;
};

QuadFrame quadFrame(const std::array<Vec3, kCorners>& corner) {
  QuadFrame frame;
  frame.corner = corner;
  frame.normal = normalized(cross(corner[2] - corner[0], corner[3] - corner[1]));
  for (std::size_t i = 0; i < kCorners; ++i) {
    frame.edge[i] = corner[(i + 1) % kCorners] - corner[i];
    frame.length[i] = norm(frame.edge[i]);
  }
  for (std::size_t i = 0; i < kCorners; ++i) {
    frame.jacobian[i] = dot(frame.normal, cross(frame.edge[(i + 3) % kCorners], frame.edge[i]));
  }
  return frame;
}

double scaledJacobianOf(const QuadFrame& frame) {
  double least = kInfinity;
  for (std::size_t i = 0; i < kCorners; ++i) {
    const double scale = frame.length[(i + 3) % kCorners] * frame.length[i];
    if (!(scale > 0.0)) return 0.0;
    least = std::min(least, frame.jacobian[i] / scale);
  }
  return std::clamp(least, -1.0, 1.0);
}

double ratioOf(const std::array<double, kCorners>& jacobian) {
  const auto [least, greatest] = std::minmax_element(jacobian.begin(), jacobian.end());
  return *least > 0.0 ? *greatest / *least : kInfinity;
}

/// The Jacobian determinant at the 2 x 2 Gauss points, bilinear between the corners.
std::array<double, kCorners> gaussJacobians(const std::array<double, kCorners>& atCorner) {
  const double g = 1.0 / std::sqrt(3.0);
  const double near = (1.0 + g) / 2.0;
  const double far = (1.0 - g) / 2.0;
  std::array<double, kCorners> result{};
  for (std::size_t i = 0; i < kCorners; ++i) {
    const double beside = atCorner[(i + 1) % kCorners] + atCorner[(i + 3) % kCorners];
    result[i] = near * near * atCorner[i] + near * far * beside + far * far * atCorner[(i + 2) % kCorners];
  }
  return result;
}

/// The longer over the shorter side of the two rectangles that are centred on one line between mid-sides and whose
/// sides pass through the other two mid-sides; the more stretched of the two.
double stretchOf(const Vec3& u, const Vec3& w) {
  const double area = norm(cross(u, w));
  if (!(area > 0.0)) return kInfinity;
  const auto ratio = [area](double squaredLength) { return std::max(squaredLength / area, area / squaredLength); };
  return std::max(ratio(squaredNorm(u)), ratio(squaredNorm(w)));
}

double aspectRatioOf(const std::array<Vec3, kCorners>& p) {
  const Vec3 u = (p[1] + p[2] - p[3] - p[0]) * 0.5;
  const Vec3 w = (p[2] + p[3] - p[0] - p[1]) * 0.5;
  return stretchOf(u, w);
}

/// Least cosine between an edge's outward normal and the way from the centroid to the edge's middle, in the mean plane.
double orthogonalQualityOf(const QuadFrame& frame) {
  const Vec3 origin = frame.corner[0];
  std::array<Vec3, kCorners> p;
  for (std::size_t i = 0; i < kCorners; ++i) p[i] = tangentPart(frame.corner[i] - origin, frame.normal);
  const double first = dot(frame.normal, cross(p[1] - p[0], p[2] - p[0]));
  const double second = dot(frame.normal, cross(p[2] - p[0], p[3] - p[0]));
  if (!(first + second > 0.0)) return 0.0;
  const Vec3 centroid = ((p[0] + p[1] + p[2]) * first + (p[0] + p[2] + p[3]) * second) / (3.0 * (first + second));
  double least = 1.0;
  for (std::size_t i = 0; i < kCorners; ++i) {
    const Vec3& a = p[i];
    const Vec3& b = p[(i + 1) % kCorners];
    const Vec3 outward = normalized(cross(b - a, frame.normal));
    const Vec3 way = normalized((a + b) * 0.5 - centroid);
    least = std::min(least, dot(outward, way));
  }
  return least;
}

/// Angle between two vectors in degrees, accurate also near 0 and 180; 0 when one of them vanishes.
double angleBetween(const Vec3& a, const Vec3& b) { return math::atan2(norm(cross(a, b)), dot(a, b)) * kDegrees; }

void measureAngles(const QuadFrame& frame, QuadMetrics& metrics) {
  metrics.minAngle = kInfinity;
  metrics.maxAngle = 0.0;
  for (std::size_t i = 0; i < kCorners; ++i) {
    double angle = angleBetween(frame.edge[i], -frame.edge[(i + 3) % kCorners]);
    if (frame.jacobian[i] < 0.0) angle = 360.0 - angle;
    metrics.minAngle = std::min(metrics.minAngle, angle);
    metrics.maxAngle = std::max(metrics.maxAngle, angle);
  }
  const double skewness = std::max((metrics.maxAngle - 90.0) / 90.0, (90.0 - metrics.minAngle) / 90.0);
  metrics.skewness = std::clamp(skewness, 0.0, 1.0);
}

double warpageOf(const std::array<Vec3, kCorners>& p) {
  const double across02 = angleBetween(cross(p[1] - p[0], p[2] - p[0]), cross(p[2] - p[0], p[3] - p[0]));
  const double across13 = angleBetween(cross(p[2] - p[1], p[3] - p[1]), cross(p[3] - p[1], p[0] - p[1]));
  return std::max(across02, across13);
}

}  // namespace

QuadMetrics quadMetrics(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const QuadFrame frame = quadFrame({a, b, c, d});
  QuadMetrics metrics;
  metrics.scaledJacobian = scaledJacobianOf(frame);
  metrics.jacobianRatio = ratioOf(frame.jacobian);
  metrics.jacobianRatioGauss = ratioOf(gaussJacobians(frame.jacobian));
  metrics.aspectRatio = aspectRatioOf(frame.corner);
  const auto [shortest, longest] = std::minmax_element(frame.length.begin(), frame.length.end());
  metrics.edgeRatio = *shortest > 0.0 ? *longest / *shortest : kInfinity;
  metrics.orthogonalQuality = orthogonalQualityOf(frame);
  measureAngles(frame, metrics);
  metrics.warpage = warpageOf(frame.corner);
  return metrics;
}

double quadScaledJacobian(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return scaledJacobianOf(quadFrame({a, b, c, d}));
}

double triangleScaledJacobian(const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::array<double, 3> length{distance(a, b), distance(b, c), distance(c, a)};
  const auto [shortest, longest] = std::minmax_element(length.begin(), length.end());
  const double middle = length[0] + length[1] + length[2] - *shortest - *longest;
  const double scale = middle * *longest;
  if (!(scale > 0.0)) return 0.0;
  return std::min(1.0, 2.0 / std::sqrt(3.0) * norm(cross(b - a, c - a)) / scale);
}

}  // namespace qmcf
