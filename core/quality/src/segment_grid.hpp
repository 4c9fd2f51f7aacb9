#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "qmcf/base/vec.hpp"

namespace qmcf::quality {

/// A line segment, or a point when both ends are equal.
using Segment = std::array<Vec3, 2>;

double distanceToSegment(const Vec3& point, const Segment& segment);

/// A uniform grid over segments, for finding those near a point.
class SegmentGrid {
 public:
  /// cell: side of the cells, near the usual length of a segment; it is enlarged where the grid would grow out of
  /// proportion. largestRadius: of any query. Complexity O(n log n).
  SegmentGrid(std::vector<Segment> segments, double cell, double largestRadius);

  /// Calls visit(index, segment) for the segments within radius of the point, some possibly more than once, until one
  /// call returns true; says whether one did. \pre radius <= largestRadius
  template <class Visit>
  bool anyWithin(const Vec3& point, double radius, Visit visit) const {
    if (segments_.empty()) return false;
    const Cell low = cellOf(point - Vec3{radius, radius, radius});
    const Cell high = cellOf(point + Vec3{radius, radius, radius});
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          for (std::size_t i = firstEntry(keyOf({x, y, z})); i < entries_.size(); ++i) {
            if (entries_[i].key != keyOf({x, y, z})) break;
            const Segment& segment = segments_[entries_[i].segment];
            if (distanceToSegment(point, segment) <= radius && visit(entries_[i].segment, segment)) return true;
          }
        }
      }
    }
    return false;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Entry {
    std::uint64_t key = 0;
    std::uint32_t segment = 0;
    bool operator<(const Entry& other) const { return key != other.key ? key < other.key : segment < other.segment; }
    bool operator==(const Entry& other) const { return key == other.key && segment == other.segment; }
  };

  [[nodiscard]] Cell cellOf(const Vec3& point) const;
  static std::uint64_t keyOf(const Cell& cell);
  /// The first entry with at least this key.
  [[nodiscard]] std::size_t firstEntry(std::uint64_t key) const;
  void insertPiece(const Vec3& a, const Vec3& b, std::uint32_t segment);

  std::vector<Segment> segments_;
  Vec3 low_;
  double cell_ = 1.0;
  std::vector<Entry> entries_;
};

}  // namespace qmcf::quality
