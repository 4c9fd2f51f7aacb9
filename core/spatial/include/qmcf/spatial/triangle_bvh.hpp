#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "qmcf/base/vec.hpp"

namespace qmcf {

/// The point of a triangle mesh closest to a query.
struct ClosestPoint {
  std::int32_t triangle = -1;  ///< -1 when the query was about a single triangle.
  std::array<double, 3> barycentric{};
  Vec3 position;
  double squaredDistance = 0.0;
};

/// The point of the triangle abc closest to the query. Any triangle will do, also one without area.
ClosestPoint closestPointOnTriangle(const Vec3& query, const Vec3& a, const Vec3& b, const Vec3& c);

/// A tree of boxes over a triangle mesh for closest-point queries. It keeps copies of what it needs.
/// Build one per face of the B-rep, so that a query never lands on another sheet.
class TriangleBvh {
 public:
  TriangleBvh() = default;
  /// Complexity O(n log n). Zero-area triangles are allowed. \pre indices are in range, positions finite.
  TriangleBvh(const std::vector<Vec3>& positions, const std::vector<std::array<std::int32_t, 3>>& triangles);

  /// True without triangles.
  [[nodiscard]] bool empty() const { return triangles_.empty(); }
  /// Unit normal of a triangle; zero if it has no area.
  [[nodiscard]] const Vec3& normal(std::int32_t triangle) const {
    return normals_[static_cast<std::size_t>(place_[static_cast<std::size_t>(triangle)])];
  }
  /// The closest point; ties go to the smallest triangle id. \pre !empty()
  /// hint: a triangle near the answer, or -1; it changes how long the search takes and nothing else, except that it is
  /// the answer itself if the query lies on it, up to the round-off of the coordinates.
  [[nodiscard]] ClosestPoint closest(const Vec3& query, std::int32_t hint = -1) const;
  /// As above among triangles whose unit normal n has dot(n, normal) >= minCosine; without any such triangle, as above.
  [[nodiscard]] ClosestPoint closest(const Vec3& query, const Vec3& normal, double minCosine,
                                     std::int32_t hint = -1) const;
  /// The closest point among triangles no farther than `reach` whose unit normal n has dot(n, normal) >= 0; its
  /// triangle is -1 if there is none.
  [[nodiscard]] ClosestPoint closestFacing(const Vec3& normal, const Vec3& query, double reach) const;
  /// Whether a triangle no farther than `reach` has a unit normal n with dot(n, normal) > 0.
  [[nodiscard]] bool isAnyFacing(const Vec3& normal, const Vec3& query, double reach) const;

 private:
  struct Node {
    Vec3 low;
    Vec3 high;
    std::int32_t first = 0;  ///< Leaf: first entry of order_. Inner: first of its two children.
    std::int32_t count = 0;  ///< Leaf: number of entries. Inner: 0.
  };

  struct Item;

  static std::int32_t divide(std::vector<Item>& items, std::int32_t first, std::int32_t last);
  void makeNodes(std::vector<Item>& items);
  void fitBoxes();

  [[nodiscard]] bool isPlaneBeyond(std::size_t index, const Vec3& query, double squaredDistance) const;

  template <class Accept>
  ClosestPoint search(const Vec3& query, std::int32_t hint, double most, Accept accept) const;

  std::vector<Node> nodes_;
  double roundOff_ = 0.0;                       ///< Distance that is no more than round-off.
  std::vector<std::int32_t> order_;             ///< Triangle ids, leaf by leaf.
  std::vector<std::int32_t> place_;             ///< Per triangle: its entry in order_.
  std::vector<std::array<Vec3, 3>> triangles_;  ///< Corners in the order of order_.
  std::vector<Vec3> normals_;                   ///< Unit normals in the order of order_.
  std::vector<Vec3> planes_;                    ///< The same where they are exact to kPlaneError, elsewhere zero.
};

}  // namespace qmcf
