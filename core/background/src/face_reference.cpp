#include "face_reference.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "qmcf/mesh/shape_operator.hpp"

namespace qmcf {

FaceReference::FaceReference(const Surface& surface) {
  triangles_.reserve(surface.triangleCount());
  for (const TriangleId t : surface.triangles()) {
    const auto corners = surface.corners(t);
    triangles_.push_back({corners[0].value, corners[1].value, corners[2].value});
  }
  vertexNormals_ = std::move(angleWeightedNormals(surface).raw());
  findPlane(surface);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Vec3 normal = normalized(surface.areaVector(TriangleId(t)));
    for (const std::int32_t v : triangles_[t]) {
      Vec3& of = vertexNormals_[static_cast<std::size_t>(v)];
      if (planar_) of = planeNormal_;
      if (of == Vec3{}) of = normal;
    }
  }
  if (planar_) return;
  std::vector<Vec3> positions;
  positions.reserve(surface.vertexCount());
  for (const VertexId v : surface.vertices()) positions.push_back(surface.position(v));
  bvh_ = TriangleBvh(positions, triangles_);
}

void FaceReference::findPlane(const Surface& surface) {
  constexpr double kTolerance = 1e-7;  // Of the face's extent: the round-off of single precision coordinates.
  Vec3 sum;
  double area = 0.0;
  for (const TriangleId t : surface.triangles()) {
    const Vec3 vector = surface.areaVector(t);
    sum += vector;
    area += norm(vector);
  }
  planeNormal_ = normalized(sum);
  planeOrigin_ = surface.position(VertexId(0));
  double extent = 0.0;
  double deviation = 0.0;
  for (const VertexId v : surface.vertices()) {
    const Vec3 offset = surface.position(v) - planeOrigin_;
    extent = std::max(extent, norm(offset));
    deviation = std::max(deviation, std::fabs(dot(offset, planeNormal_)));
  }
  planar_ = deviation <= kTolerance * extent && norm(sum) >= (1.0 - 1e-9) * area && area > 0.0;
}

FaceReference::Foot FaceReference::project(const Vec3& p, const Vec3& normal, std::int32_t hint) const {
  constexpr double kMinCosine = 0.5;
  if (planar_) return {p - planeNormal_ * dot(p - planeOrigin_, planeNormal_), planeNormal_, -1};
  const ClosestPoint closest = bvh_.closest(p, normal, kMinCosine, hint);
  const auto& corners = triangles_[static_cast<std::size_t>(closest.triangle)];
  Vec3 sum;
  for (std::size_t c = 0; c < 3; ++c) sum += vertexNormal(corners[c]) * closest.barycentric[c];
  const Vec3 smooth = normalized(sum);
  return {closest.position, smooth == Vec3{} ? normal : smooth, closest.triangle};
}

}  // namespace qmcf
