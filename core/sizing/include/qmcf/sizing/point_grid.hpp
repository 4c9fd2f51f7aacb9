#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/ids.hpp"

namespace qmcf {

/// Some of a list of points in cubes, for neighbours within one cube's width.
class PointGrid {
 public:
  PointGrid(const std::vector<Vec3>& position, const std::vector<std::int32_t>& ids, double width) : width_(width) {
    entries_.reserve(ids.size());
    for (const std::int32_t n : ids) entries_.push_back({cellOf(position[static_cast<std::size_t>(n)]), n});
    std::sort(entries_.begin(), entries_.end());
  }

  /// Calls visit(id) for all points within one width of p, and for some that are farther.
  template <class Visit>
  void forEachNear(const Vec3& p, Visit visit) const {
    const Cell center = cellOf(p);
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        // The three cells along z follow each other in the order of the entries.
        const Cell first{center[0] + dx, center[1] + dy, center[2] - 1};
        const Cell last{center[0] + dx, center[1] + dy, center[2] + 1};
        auto it = std::lower_bound(entries_.begin(), entries_.end(), Entry{first, kNone});
        for (; it != entries_.end() && it->first <= last; ++it) visit(it->second);
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  using Entry = std::pair<Cell, std::int32_t>;

  [[nodiscard]] Cell cellOf(const Vec3& p) const {
    return {static_cast<std::int64_t>(std::floor(p.x / width_)), static_cast<std::int64_t>(std::floor(p.y / width_)),
            static_cast<std::int64_t>(std::floor(p.z / width_))};
  }

  double width_;
  std::vector<Entry> entries_;
};

}  // namespace qmcf
