#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "qmcf/base/vec.hpp"

namespace qmcf {

/// Quadrilaterals that fill a loop of vertices with one or two irregular vertices or none.
struct SidePattern {
  std::vector<std::array<int, 4>>
      cells;                ///< Corners, counter-clockwise: first the loop's vertices, then the inner ones.
  std::vector<Vec3> inner;  ///< Where the inner vertices belong, by transfinite interpolation of the loop.
};

/// Fills a loop that has 3, 4 or 5 convex corners, each with one quadrilateral, and two at every other vertex: a grid
/// between four corners, a vertex with three or five quadrilaterals in the middle of three or five. corners: indices
/// into the loop, ascending. Nothing when the lengths of the sides do not allow it.
std::optional<SidePattern> fillSides(const std::vector<Vec3>& loop, const std::vector<int>& corners);

/// A cut through a loop between two of its vertices, of so many edges.
struct SideCut {
  int from = 0;
  int to = 0;
  int length = 1;
  int cells = 0;  ///< Quadrilaterals that the loop is filled with.
};

/// Cuts of such a loop with 2, 4 or 6 corners in two, from side to side, after which each part can be filled around one
/// vertex: two vertices with three quadrilaterals, one with three and one with five, or two with five. Four sides can
/// be filled so whatever their lengths, if these have an even sum and leave room. Those whose lines are nearest to one
/// length of edge, at most `most` of them, the best first.
std::vector<SideCut> cutsInTwo(const std::vector<Vec3>& loop, const std::vector<int>& corners, std::size_t most);

/// Fills the loop so. \pre cut is one of cutsInTwo()
SidePattern fillCut(const std::vector<Vec3>& loop, const std::vector<int>& corners, const SideCut& cut);

}  // namespace qmcf
