#include "segment_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace qmcf::quality {
namespace {

constexpr int kBitsPerAxis = 21;
constexpr std::int64_t kMostCells = std::int64_t{1} << kBitsPerAxis;
/// Pieces a segment is cut into on average, at most: long segments may not fill the grid with entries.
constexpr double kPiecesPerSegment = 8.0;

}  // namespace

double distanceToSegment(const Vec3& point, const Segment& segment) {
  const Vec3 along = segment[1] - segment[0];
  const Vec3 way = point - segment[0];
  const double squaredLength = squaredNorm(along);
  const double t = squaredLength > 0.0 ? std::clamp(dot(way, along) / squaredLength, 0.0, 1.0) : 0.0;
  return norm(way - along * t);
}

SegmentGrid::SegmentGrid(std::vector<Segment> segments, double cell, double largestRadius)
    : segments_(std::move(segments)) {
  if (segments_.empty()) return;
  low_ = segments_[0][0];
  Vec3 high = low_;
  double length = 0.0;
  for (const Segment& segment : segments_) {
    length += distance(segment[0], segment[1]);
    for (const Vec3& end : segment) {
      low_ = {std::min(low_.x, end.x), std::min(low_.y, end.y), std::min(low_.z, end.z)};
      high = {std::max(high.x, end.x), std::max(high.y, end.y), std::max(high.z, end.z)};
    }
  }
  const double extent = std::max({high.x - low_.x, high.y - low_.y, high.z - low_.z});
  const double count = static_cast<double>(segments_.size());
  cell_ = std::max(
      {cell, largestRadius, 2.0 * extent / static_cast<double>(kMostCells), length / (count * kPiecesPerSegment)});
  if (!(cell_ > 0.0)) cell_ = 1.0;

  entries_.reserve(segments_.size() * 2);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const auto& [a, b] = segments_[i];
    const auto pieces = std::max(1, static_cast<int>(std::ceil(distance(a, b) / cell_)));
    for (int k = 0; k < pieces; ++k) {
      insertPiece(a + (b - a) * (k / static_cast<double>(pieces)),
                  a + (b - a) * ((k + 1) / static_cast<double>(pieces)), static_cast<std::uint32_t>(i));
    }
  }
  std::sort(entries_.begin(), entries_.end());
  entries_.erase(std::unique(entries_.begin(), entries_.end()), entries_.end());
}

void SegmentGrid::insertPiece(const Vec3& a, const Vec3& b, std::uint32_t segment) {
  const Cell first = cellOf({std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)});
  const Cell last = cellOf({std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)});
  for (std::int64_t x = first[0]; x <= last[0]; ++x) {
    for (std::int64_t y = first[1]; y <= last[1]; ++y) {
      for (std::int64_t z = first[2]; z <= last[2]; ++z) entries_.push_back({keyOf({x, y, z}), segment});
    }
  }
}

SegmentGrid::Cell SegmentGrid::cellOf(const Vec3& point) const {
  const auto along = [this](double value, double low) {
    const double cell = std::floor((value - low) / cell_);
    return static_cast<std::int64_t>(std::clamp(cell, 0.0, static_cast<double>(kMostCells - 1)));
  };
  return {along(point.x, low_.x), along(point.y, low_.y), along(point.z, low_.z)};
}

std::uint64_t SegmentGrid::keyOf(const Cell& cell) {
  return (static_cast<std::uint64_t>(cell[0]) << (2 * kBitsPerAxis)) |
         (static_cast<std::uint64_t>(cell[1]) << kBitsPerAxis) | static_cast<std::uint64_t>(cell[2]);
}

std::size_t SegmentGrid::firstEntry(std::uint64_t key) const {
  const auto found = std::lower_bound(entries_.begin(), entries_.end(), key,
                                      [](const Entry& entry, std::uint64_t wanted) { return entry.key < wanted; });
  return static_cast<std::size_t>(found - entries_.begin());
}

}  // namespace qmcf::quality
