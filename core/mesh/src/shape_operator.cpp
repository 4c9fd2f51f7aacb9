#include "qmcf/mesh/shape_operator.hpp"

#include <array>
#include <cstddef>

namespace qmcf {

ShapeOperator triangleShape(const Surface& surface, const IdMap<VertexId, Vec3>& normal, TriangleId t) {
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
    const Vec3 change = normal[b] - normal[a];
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
  return {std::complex<double>(0.5 * (e - g), f), 0.5 * (e + g)};
}

IdMap<VertexId, Vec3> angleWeightedNormals(const Surface& surface) {
  IdMap<VertexId, Vec3> normals(surface.vertexCount());
  for (const TriangleId t : surface.triangles()) {
    const Vec3 normal = normalized(surface.areaVector(t));
    for (int c = 0; c < 3; ++c) {
      const HalfedgeId h = Surface::halfedge(t, c);
      normals[surface.origin(h)] += normal * surface.angle(h);
    }
  }
  for (Vec3& normal : normals.raw()) normal = normalized(normal);
  return normals;
}

}  // namespace qmcf
