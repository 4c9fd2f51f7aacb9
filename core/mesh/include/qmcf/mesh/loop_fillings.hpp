#pragma once

#include <array>
#include <vector>

namespace qmcf {

/// One way of filling a loop of vertices with quadrilaterals: their corners as indices into the loop,
/// counter-clockwise. The index that equals the loop's length is a new vertex in the middle.
struct LoopFilling {
  std::vector<std::array<int, 4>> cells;
  bool hasMiddle = false;
};

/// All ways of filling a loop of 4, 6, 8 or 10 vertices with quadrilaterals and at most one new vertex; empty for other
/// lengths. Each way occurs once.
const std::vector<LoopFilling>& loopFillings(int length);

}  // namespace qmcf
