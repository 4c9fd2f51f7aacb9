// Principal curvatures as in Rusinkiewicz 2004. The shape operators are averaged as symmetric matrices in space, which
// needs no parallel transport between the tangent planes of neighbours.
#include "curvature_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "qmcf/mesh/shape_operator.hpp"

namespace qmcf {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// xx, yy, zz, yz, zx, xy.
using Symmetric = std::array<double, 6>;

void add(Symmetric& to, const Symmetric& from, double factor) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * from[i];
}

Vec3 product(const Symmetric& m, const Vec3& v) {
  return {m[0] * v.x + m[5] * v.y + m[4] * v.z, m[5] * v.x + m[1] * v.y + m[3] * v.z,
          m[4] * v.x + m[3] * v.y + m[2] * v.z};
}

/// The shape operator of a triangle as a matrix in space.
Symmetric inSpace(const Surface& surface, TriangleId t, const ShapeOperator& shape) {
  const auto corners = surface.corners(t);
  const Vec3 x = normalized(surface.position(corners[1]) - surface.position(corners[0]));
  const Vec3 y = cross(normalized(surface.areaVector(t)), x);
  const double e = shape.mean + shape.deviator.real();
  const double f = shape.deviator.imag();
  const double g = shape.mean - shape.deviator.real();
  const auto entry = [&](double xa, double ya, double xb, double yb) {
    return e * xa * xb + f * (xa * yb + ya * xb) + g * ya * yb;
  };
  return {entry(x.x, y.x, x.x, y.x), entry(x.y, y.y, x.y, y.y), entry(x.z, y.z, x.z, y.z),
          entry(x.y, y.y, x.z, y.z), entry(x.z, y.z, x.x, y.x), entry(x.x, y.x, x.y, y.y)};
}

/// The larger absolute principal curvature of a matrix in the plane across a unit normal.
double largestAcross(const Symmetric& m, const Vec3& normal) {
  const Vec3 axis = std::fabs(normal.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 x = normalized(tangentPart(axis, normal));
  const Vec3 y = cross(normal, x);
  const double e = dot(x, product(m, x));
  const double f = dot(x, product(m, y));
  const double g = dot(y, product(m, y));
  const double half = 0.5 * (e - g);
  return std::sqrt(half * half + f * f) + 0.5 * std::fabs(e + g);
}

/// Per vertex of a face. One averaging: more would carry curvature over large flat triangles.
std::vector<double> vertexCurvatures(const Surface& surface, const IdMap<VertexId, Vec3>& normals,
                                     const IdMap<TriangleId, Symmetric>& shape) {
  IdMap<VertexId, Symmetric> sum(surface.vertexCount());
  IdMap<VertexId, double> weight(surface.vertexCount(), 0.0);
  // By angles, not areas: a large flat triangle beside a rounding says no more about it than a small one.
  for (const HalfedgeId h : surface.halfedges()) {
    const double angle = surface.angle(h);
    add(sum[surface.origin(h)], shape[Surface::triangle(h)], angle);
    weight[surface.origin(h)] += angle;
  }
  std::vector<double> curvature;
  for (const VertexId v : surface.vertices()) {
    curvature.push_back(weight[v] > 0.0 ? largestAcross(sum[v], normals[v]) / weight[v] : 0.0);
  }
  return curvature;
}

/// At the edges of a face normals are one-sided: what its inner neighbours have is nearer the truth, if there are any.
/// But what is seen from one side is at least half of it: where that is flat, a neighbour beyond a large triangle is
/// not.
void averageIntoEdges(const Surface& surface, std::vector<double>& curvature) {
  std::vector<double> sum(curvature.size(), 0.0);
  std::vector<int> count(curvature.size(), 0);
  const auto addTo = [&](VertexId to, VertexId from) {
    if (!surface.isBoundary(to) || surface.isBoundary(from)) return;
    sum[to.index()] += curvature[from.index()];
    ++count[to.index()];
  };
  for (const HalfedgeId h : surface.halfedges()) {
    addTo(surface.origin(h), surface.target(h));
    addTo(surface.target(h), surface.origin(h));
  }
  for (std::size_t v = 0; v < curvature.size(); ++v) {
    if (count[v] > 0) curvature[v] = std::min(sum[v] / count[v], 2.0 * curvature[v]);
  }
}

}  // namespace

double chordLength(double curvature, double chordError) {
  if (!(curvature > 0.0)) return kInfinity;
  const double e = std::min(chordError, 1.0 / curvature);
  return 2.0 * std::sqrt(e * (2.0 / curvature - e));
}

CurvatureSizes curvatureSizes(const TriangleMesh& mesh, const Brep& brep, double chordError) {
  CurvatureSizes sizes;
  sizes.vertex.assign(mesh.positions.size(), kInfinity);
  sizes.triangle.assign(mesh.triangles.size(), kInfinity);
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    const FaceSurface& cut = brep.cuts[f];
    const IdMap<VertexId, Vec3> normals = angleWeightedNormals(cut.surface);
    IdMap<TriangleId, Symmetric> shape(cut.surface.triangleCount());
    for (const TriangleId t : cut.surface.triangles()) {
      const ShapeOperator own = triangleShape(cut.surface, normals, t);
      shape[t] = inSpace(cut.surface, t, own);
      const double curvature = std::sqrt(std::norm(own.deviator)) + std::fabs(own.mean);
      sizes.triangle[static_cast<std::size_t>(cut.triangleOrigin[t.index()])] = chordLength(curvature, chordError);
    }
    std::vector<double> curvature = vertexCurvatures(cut.surface, normals, shape);
    averageIntoEdges(cut.surface, curvature);
    for (std::size_t v = 0; v < curvature.size(); ++v) {
      double& size = sizes.vertex[static_cast<std::size_t>(cut.vertexPoint[v])];
      size = std::min(size, chordLength(curvature[v], chordError));
    }
  }
  return sizes;
}

}  // namespace qmcf
