#include "curvature.hpp"

#include <algorithm>
#include <cmath>

#include "corner_frame.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/mesh/shape_operator.hpp"

namespace qmcf {

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
  for (const TriangleId t : surface.triangles()) shape[t] = triangleShape(surface, patch.normal, t);
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
