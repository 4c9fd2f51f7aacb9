#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "qmcf/base/bounding_box.hpp"
#include "qmcf/base/vec.hpp"

namespace qmcf::detail {

/// Finds the points near a place: points sorted by the cell of a regular grid that they lie in.
class PointGrid {
 public:
  /// cell: edge length of a cell; raised so that the box has at most 2^20 cells per side.
  PointGrid(const std::vector<Vec3>& positions, const std::vector<std::int32_t>& points, double cell) {
    for (const std::int32_t v : points) box_.include(positions[static_cast<std::size_t>(v)]);
    cell_ = std::fmax(cell, points.empty() ? 1.0 : box_.diagonal() * 0x1.0p-20);
    entries_.reserve(points.size());
    for (const std::int32_t v : points) {
      const auto [x, y, z] = cellOf(positions[static_cast<std::size_t>(v)]);
      entries_.emplace_back(key(x, y, z), v);
    }
    std::sort(entries_.begin(), entries_.end());
  }

  [[nodiscard]] double cell() const { return cell_; }

  /// Calls visit(point) for every point in the 27 cells around p, thus for all within a cell's length.
  template <class Visit>
  void forEachNear(const Vec3& p, Visit visit) const {
    const auto [x, y, z] = cellOf(p);
    for (std::int64_t i = x - 1; i <= x + 1; ++i) {
      for (std::int64_t j = y - 1; j <= y + 1; ++j) {
        for (std::int64_t k = z - 1; k <= z + 1; ++k) {
          if (i < 0 || j < 0 || k < 0) continue;
          const std::pair<std::uint64_t, std::int32_t> first{key(i, j, k), 0};
          for (auto it = std::lower_bound(entries_.begin(), entries_.end(), first);
               it != entries_.end() && it->first == first.first; ++it) {
            visit(it->second);
          }
        }
      }
    }
  }

 private:
  struct Cell {
    std::int64_t x, y, z;
  };
  [[nodiscard]] Cell cellOf(const Vec3& p) const {
    const Vec3 q = (p - box_.low) / cell_;
    // Places outside the box are near no point beyond its outermost cells.
    const auto index = [](double c) {
      return static_cast<std::int64_t>(std::floor(std::fmin(std::fmax(c, -2.0), 0x1.0p20 + 2.0)));
    };
    return {index(q.x), index(q.y), index(q.z)};
  }
  static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
    return (static_cast<std::uint64_t>(x) << 42U) | (static_cast<std::uint64_t>(y) << 21U) |
           static_cast<std::uint64_t>(z);
  }

  BoundingBox box_;
  double cell_ = 1.0;
  std::vector<std::pair<std::uint64_t, std::int32_t>> entries_;
};

}  // namespace qmcf::detail
