#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// The input triangles of one face as the place where the vertices of its remesh belong, with smooth normals.
class FaceReference {
 public:
  struct Foot {
    Vec3 position;
    Vec3 normal;                 ///< Unit normal, smooth across the face.
    std::int32_t triangle = -1;  ///< Triangle of the face's surface; -1 on a planar face.
  };

  explicit FaceReference(const Surface& surface);

  /// The closest point of the face among triangles that look roughly along `normal`. hint: a triangle near it, or -1.
  [[nodiscard]] Foot project(const Vec3& p, const Vec3& normal, std::int32_t hint = -1) const;
  /// Unit normal at a vertex of the face's surface: the angle-weighted mean of its triangles.
  [[nodiscard]] const Vec3& vertexNormal(std::int32_t v) const { return vertexNormals_[static_cast<std::size_t>(v)]; }
  /// Whether all triangles lie in one plane and look the same way.
  [[nodiscard]] bool isPlanar() const { return planar_; }

 private:
  void findPlane(const Surface& surface);

  TriangleBvh bvh_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
  std::vector<Vec3> vertexNormals_;
  bool planar_ = false;
  Vec3 planeOrigin_;
  Vec3 planeNormal_;
};

}  // namespace qmcf
