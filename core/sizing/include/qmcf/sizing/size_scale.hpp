#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"

namespace qmcf {

/// Sizes that vary of themselves: a factor of the base size over the faces, in (0, 1], linear in a triangulation of
/// each.
class SizeScale {
 public:
  struct Face {
    std::vector<Vec3> positions;
    std::vector<std::array<std::int32_t, 3>> triangles;
    std::vector<double> factor;  ///< Per position, in (0, 1].
  };

  /// The same everywhere.
  SizeScale() = default;
  /// Per face of the B-rep, in its order. \pre every face has a triangle
  explicit SizeScale(std::vector<Face> faces);

  [[nodiscard]] bool empty() const { return faces_.empty(); }
  /// At the point of the face that is closest. \pre face is an index of the faces given
  [[nodiscard]] double at(std::int32_t face, const Vec3& p) const;
  /// The one factor that would make as many elements; 1 where there are no faces.
  [[nodiscard]] double mean() const { return mean_; }
  /// The length of the triangulations' edges, in the mean.
  [[nodiscard]] double spacing() const { return spacing_; }

 private:
  struct Factors {
    TriangleBvh tree;
    std::vector<std::array<double, 3>> corner;  ///< Per triangle.
  };

  std::vector<Factors> faces_;
  double mean_ = 1.0;
  double spacing_ = 0.0;
};

}  // namespace qmcf
