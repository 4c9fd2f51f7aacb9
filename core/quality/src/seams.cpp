#include "seams.hpp"

#include <algorithm>
#include <array>

#include "segment_grid.hpp"

namespace qmcf::quality {
namespace {

constexpr double kCrackTolerance = 1e-9;  ///< Of the diagonal.
constexpr double kSeamTolerance = 1e-6;   ///< Of the diagonal.

}  // namespace

Seams findSeams(const std::vector<Vec3>& positions, const Structure& structure, double diagonal) {
  const auto at = [&](std::int32_t v) -> const Vec3& { return positions[static_cast<std::size_t>(v)]; };
  std::vector<std::array<std::int32_t, 2>> ends;
  std::vector<Segment> segments;
  for (const EdgeRecord& edge : structure.edges.edges) {
    if (edge.useCount != 1) continue;
    ends.push_back({edge.low, edge.high});
    segments.push_back({at(edge.low), at(edge.high)});
  }
  Seams result;
  if (segments.empty()) return result;
  const double near = kSeamTolerance * diagonal;
  const double same = kCrackTolerance * diagonal;
  const double meanLength = structure.boundaryLength / static_cast<double>(segments.size());
  const SegmentGrid grid(std::move(segments), meanLength, near);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (structure.onBoundary[v] == 0) continue;
    const Vec3& p = positions[v];
    const auto id = static_cast<std::int32_t>(v);
    bool crack = false;
    bool tJunction = false;
    grid.anyWithin(p, near, [&](std::uint32_t i, const Segment& segment) {
      if (ends[i][0] == id || ends[i][1] == id) return false;
      result.any = true;
      const double toEnd = std::min(distance(p, segment[0]), distance(p, segment[1]));
      crack = crack || toEnd <= same;
      tJunction = tJunction || toEnd > near;
      return false;
    });
    if (crack) result.cracks.push_back(id);
    if (tJunction) result.tJunctions.push_back(id);
  }
  return result;
}

}  // namespace qmcf::quality
