#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/sizing/size_field.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"

namespace qmcf {

/// The sizes inside one face (SizeField::inner) at any point.
class FaceSizes {
 public:
  struct Found {
    double size = 0.0;
    std::int32_t triangle = kNone;  ///< Of this face's sizes: a hint for points nearby.
  };

  FaceSizes() = default;
  FaceSizes(const SizeField& field, std::int32_t face);

  /// Nothing is asked for that is below the base size.
  [[nodiscard]] bool empty() const { return tree_.empty(); }
  /// At the closest point of the face. hint: a triangle near it, or kNone. \pre !empty()
  [[nodiscard]] Found at(const Vec3& p, std::int32_t hint) const;

 private:
  TriangleBvh tree_;
  std::vector<std::array<double, 3>> size_;  ///< Per triangle, at its corners.
};

}  // namespace qmcf
