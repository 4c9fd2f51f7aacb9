#include "curvature.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "corner_frame.hpp"
#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

struct ShapeOperator {
  Complex deviator;
  double mean = 0.0;
};

/// The symmetric matrix (e f; f g) that maps the triangle's edges to the changes of the normal along them, by least
/// squares over the three edges, in the triangle's own frame; zero in a degenerate triangle.
ShapeOperator triangleShape(const Patch& patch, TriangleId t) {
  const Surface& surface = patch.surface;
  const auto corners = surface.corners(t);
  const Vec3 x = normalized(surface.position(corners[1]) - surface.position(corners[0]));
  const Vec3 y = cross(normalized(surface.areaVector(t)), x);
  double uu = 0.0;
  double uv = 0.0;
  double vv = 0.0;
  std::array<double, 3> side{};
  for (std::size_t c = 0; c < 3; ++c) {
    const VertexId a = corners[c];
    const VertexId b = corners[(c + 1) % 3];
    const Vec3 edge = surface.position(b) - surface.position(a);
    const Vec3 change = patch.normal[b] - patch.normal[a];
    const double u = dot(edge, x);
    const double v = dot(edge, y);
    uu += u * u;
    uv += u * v;
    vv += v * v;
    side[0] += u * dot(change, x);
    side[1] += v * dot(change, x) + u * dot(change, y);
    side[2] += v * dot(change, y);
  }
  // Cramer's rule for (uu uv 0; uv uu+vv uv; 0 uv vv) (e f g) = side.
  const double sum = uu + vv;
  const double minor = uu * vv - uv * uv;
  const double determinant = sum * minor;
  if (!(determinant > 1e-12 * sum * sum * sum)) return {};
  const double e = (side[0] * (sum * vv - uv * uv) - side[1] * uv * vv + side[2] * uv * uv) / determinant;
  const double f = (-side[0] * uv * vv + side[1] * uu * vv - side[2] * uu * uv) / determinant;
  const double g = (side[0] * uv * uv - side[1] * uu * uv + side[2] * (uu * sum - uv * uv)) / determinant;
  return {Complex(0.5 * (e - g), f), 0.5 * (e + g)};
}

}  // namespace

double CurvatureField::anisotropy(Eigen::Index v) const {
  const double half = std::sqrt(std::norm(deviator[v]));
  const double larger = std::max(half, std::fabs(mean[v]));
  return larger > 0.0 ? half / larger : 0.0;
}

double CurvatureField::largest(Eigen::Index v) const { return std::sqrt(std::norm(deviator[v])) + std::fabs(mean[v]); }

Complex CurvatureField::directions(Eigen::Index v) const { return math::normalized(deviator[v] * deviator[v]); }

CurvatureField estimateCurvature(const Patch& patch, const Connection& connection, int rounds) {
  const Surface& surface = patch.surface;
  const auto count = static_cast<Eigen::Index>(surface.vertexCount());
  IdMap<TriangleId, ShapeOperator> shape(surface.triangleCount());
  IdMap<HalfedgeId, Complex> toVertex(surface.halfedgeCount());
  for (const TriangleId t : surface.triangles()) shape[t] = triangleShape(patch, t);
  for (const HalfedgeId h : surface.halfedges()) toVertex[h] = math::unitComplex(-2.0 * cornerTurn(connection, h, 0.5));
  CurvatureField result;
  for (int round = 0; round < rounds; ++round) {
    result = {FieldVector::Zero(count), Eigen::VectorXd::Zero(count)};
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(count);
    for (const HalfedgeId h : surface.halfedges()) {
      const TriangleId t = Surface::triangle(h);
      const Eigen::Index v = surface.origin(h).value;
      const double area = norm(surface.areaVector(t));
      weight[v] += area;
      result.deviator[v] += area * shape[t].deviator * toVertex[h];
      result.mean[v] += area * shape[t].mean;
    }
    for (Eigen::Index v = 0; v < count; ++v) {
      if (weight[v] <= 0.0) continue;
      result.deviator[v] /= weight[v];
      result.mean[v] /= weight[v];
    }
    for (const TriangleId t : surface.triangles()) {
      shape[t] = {};
      for (int c = 0; c < 3; ++c) {
        const HalfedgeId h = Surface::halfedge(t, c);
        const Eigen::Index v = surface.origin(h).value;
        shape[t].deviator += result.deviator[v] * std::conj(toVertex[h]) / 3.0;
        shape[t].mean += result.mean[v] / 3.0;
      }
    }
  }
  return result;
}

}  // namespace qmcf
