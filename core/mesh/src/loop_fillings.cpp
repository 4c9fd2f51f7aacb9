#include "qmcf/mesh/loop_fillings.hpp"

#include <algorithm>

namespace qmcf {
namespace {

using Cells = std::vector<std::array<int, 4>>;
using Polygon = std::vector<int>;

Polygon part(const Polygon& polygon, std::size_t from, std::size_t to) {
  return {polygon.begin() + static_cast<std::ptrdiff_t>(from), polygon.begin() + static_cast<std::ptrdiff_t>(to) + 1};
}

std::vector<Cells> product(const std::vector<Cells>& left, const std::vector<Cells>& right) {
  std::vector<Cells> all;
  for (const Cells& l : left) {
    for (const Cells& r : right) {
      all.push_back(l);
      all.back().insert(all.back().end(), r.begin(), r.end());
    }
  }
  return all;
}

/// All quadrangulations of a polygon without new vertices: the quad at its first edge has its other corners at i < j,
/// and each polygon that it cuts off has an even number of corners.
std::vector<Cells> quadrangulations(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  if (n == 2) return {{}};
  std::vector<Cells> all;
  for (std::size_t i = 2; i < n; i += 2) {
    for (std::size_t j = i + 1; j < n; j += 2) {
      Polygon last = part(polygon, j, n - 1);
      last.push_back(polygon[0]);
      const Cells quad{{polygon[0], polygon[1], polygon[i], polygon[j]}};
      const auto rest = product(quadrangulations(part(polygon, 1, i)),
                                product(quadrangulations(part(polygon, i, j)), quadrangulations(last)));
      for (const Cells& cells : product({quad}, rest)) all.push_back(cells);
    }
  }
  return all;
}

/// Adds the ways in which the middle is joined to the chosen loop vertices (ascending, of one parity).
void addWithMiddle(int length, const std::vector<int>& joined, std::vector<LoopFilling>& all) {
  std::vector<Cells> ways{{}};
  for (std::size_t s = 0; s < joined.size(); ++s) {
    const int from = joined[s];
    const int to = s + 1 < joined.size() ? joined[s + 1] : joined[0] + length;
    Polygon sector{length};
    for (int i = from; i <= to; ++i) sector.push_back(i % length);
    // Only ways in which no chord leaves the middle: those belong to a larger set of joined vertices.
    std::vector<Cells> own;
    for (const Cells& cells : quadrangulations(sector)) {
      const auto atMiddle = std::count_if(cells.begin(), cells.end(), [&](const auto& cell) {
        return std::find(cell.begin(), cell.end(), length) != cell.end();
      });
      if (atMiddle == 1) own.push_back(cells);
    }
    ways = product(ways, own);
  }
  for (const Cells& cells : ways) all.push_back({cells, true});
}

std::vector<LoopFilling> allFillings(int length) {
  Polygon loop;
  for (int i = 0; i < length; ++i) loop.push_back(i);
  std::vector<LoopFilling> all;
  for (const Cells& cells : quadrangulations(loop)) all.push_back({cells, false});
  for (int parity = 0; parity < 2; ++parity) {
    for (unsigned subset = 0; subset < (1U << static_cast<unsigned>(length / 2)); ++subset) {
      std::vector<int> joined;
      for (int i = 0; i < length / 2; ++i) {
        if ((subset >> static_cast<unsigned>(i) & 1U) != 0U) joined.push_back(2 * i + parity);
      }
      if (joined.size() >= 3) addWithMiddle(length, joined, all);
    }
  }
  return all;
}

}  // namespace

const std::vector<LoopFilling>& loopFillings(int length) {
  static const std::vector<LoopFilling> kNoFillings;
  static const std::array<std::vector<LoopFilling>, 4> kFillings{allFillings(4), allFillings(6), allFillings(8),
                                                                 allFillings(10)};
  if (length < 4 || length > 10 || length % 2 != 0) return kNoFillings;
  return kFillings[static_cast<std::size_t>(length / 2 - 2)];
}

}  // namespace qmcf
