#pragma once

#include <algorithm>
#include <array>
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
  /// cell: edge length of a cell; raised so that the box has at most 2^40 cells per side.
  PointGrid(const std::vector<Vec3>& positions, const std::vector<std::int32_t>& points, double cell) {
    for (const std::int32_t v : points) box_.include(positions[static_cast<std::size_t>(v)]);
    cell_ = points.empty() ? std::fmax(cell, 1.0) : std::fmax(cell, box_.diagonal() * 0x1.0p-40);
    entries_.reserve(points.size());
    for (const std::int32_t v : points) entries_.emplace_back(cellOf(positions[static_cast<std::size_t>(v)]), v);
    std::sort(entries_.begin(), entries_.end());
  }

  [[nodiscard]] double cell() const { return cell_; }

  /// Calls visit(point) for every point in the 27 cells around p, thus for all within a cell's length.
  template <class Visit>
  void forEachNear(const Vec3& p, Visit visit) const {
    const auto [x, y, z] = cellOf(p);
    for (std::int64_t i = x - 1; i <= x + 1; ++i) {
      for (std::int64_t j = y - 1; j <= y + 1; ++j) {
        // The three cells along z follow each other in the order of the entries.
        const Cell last{i, j, z + 1};
        auto it = std::lower_bound(entries_.begin(), entries_.end(), Entry{{i, j, z - 1}, 0});
        for (; it != entries_.end() && it->first <= last; ++it) visit(it->second);
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  using Entry = std::pair<Cell, std::int32_t>;

  [[nodiscard]] Cell cellOf(const Vec3& p) const {
    const Vec3 q = (p - box_.low) / cell_;
    // Places outside the box are near no point beyond its outermost cells.
    const auto index = [](double c) {
      return static_cast<std::int64_t>(std::floor(std::fmin(std::fmax(c, -2.0), 0x1.0p40 + 2.0)));
    };
    return {index(q.x), index(q.y), index(q.z)};
  }

  BoundingBox box_;
  double cell_ = 1.0;
  std::vector<Entry> entries_;
};

}  // namespace qmcf::detail
