#include "narrow_faces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace qmcf {
namespace {

/// Radians. A quadrilateral in such a corner has a scaled Jacobian below 0.55, and its neighbours are sheared.
constexpr double kSharpest = 0.58;

bool isTip(const Coedge& coedge) { return coedge.cornerQuads == 1 && coedge.cornerAngle < kSharpest; }

/// As sidesOf(), from the first coedge on that `isFirst` holds for; empty without one.
template <class IsFirst>
std::vector<std::vector<Coedge>> sidesFrom(const BrepLoop& loop, IsFirst isFirst) {
  std::vector<std::vector<Coedge>> sides;
  const auto& coedges = loop.coedges;
  const auto first = std::find_if(coedges.begin(), coedges.end(), isFirst);
  if (first == coedges.end()) return sides;
  const auto add = [&sides](const Coedge& coedge) {
    if (isCorner(coedge)) sides.emplace_back();
    sides.back().push_back(coedge);
  };
  std::for_each(first, coedges.end(), add);
  std::for_each(coedges.begin(), first, add);
  return sides;
}

/// The face with its sharpest obtuse corners taken for corners of one quadrilateral until there are so many more to the
/// left than to the right.
BrepFace withCorners(BrepFace face, std::int32_t corners) {
  constexpr double kMostObtuse = 2.8;  // Radians.
  if (face.loops.size() != 1) return face;
  for (std::int32_t turn = turnOf(face.loops[0]); turn < corners; ++turn) {
    Coedge* sharpest = nullptr;
    for (Coedge& coedge : face.loops[0].coedges) {
      if (isCorner(coedge) || !(coedge.cornerAngle < kMostObtuse)) continue;
      if (sharpest == nullptr || coedge.cornerAngle < sharpest->cornerAngle) sharpest = &coedge;
    }
    if (sharpest == nullptr) break;
    sharpest->cornerQuads = 1;
  }
  return face;
}

}  // namespace

std::int32_t turnOf(const BrepLoop& loop) {
  std::int32_t turn = 0;
  for (const Coedge& coedge : loop.coedges) turn += 2 - coedge.cornerQuads;
  return turn;
}

std::vector<std::vector<Coedge>> sidesOf(const BrepLoop& loop) { return sidesFrom(loop, isCorner); }

double rowsAcross(const Brep& brep, const BrepFace& face, const std::vector<double>& wanted) {
  double length = 0.0;
  double divisions = 0.0;
  for (const BrepLoop& loop : face.loops) {
    for (const Coedge& coedge : loop.coedges) {
      length += brep.edges[static_cast<std::size_t>(coedge.edge)].length;
      divisions += wanted[static_cast<std::size_t>(coedge.edge)];
    }
  }
  return length > 0.0 ? 2.0 * face.area / length * divisions / length : 0.0;
}

std::optional<RowSides> taperedSides(const BrepFace& face) {
  if (face.loops.size() != 1) return std::nullopt;
  const auto& coedges = face.loops[0].coedges;
  const bool hasEnd = std::count_if(coedges.begin(), coedges.end(), isTip) == 1;
  auto sides = sidesFrom(hasEnd ? withCorners(face, 3).loops[0] : face.loops[0], isTip);
  if (sides.size() != (hasEnd ? 3 : 2)) return std::nullopt;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].front().cornerQuads != 1 || isTip(sides[i].front()) == hasEnd) return std::nullopt;
  }
  RowSides row{std::move(sides.front()), std::move(sides.back()), {}};
  if (hasEnd) row.ends.push_back(std::move(sides[1]));
  return row;
}

std::optional<RowSides> fourSides(const Brep& brep, const BrepFace& face) {
  if (face.loops.size() != 1) return std::nullopt;
  auto sides = sidesOf(face.loops[0]);
  if (sides.size() != 4) return std::nullopt;
  std::array<double, 2> length{};
  for (std::size_t i = 0; i < 4; ++i) {
    if (sides[i].front().cornerQuads != 1) return std::nullopt;
    for (const Coedge& coedge : sides[i]) length[i % 2] += brep.edges[static_cast<std::size_t>(coedge.edge)].length;
  }
  const std::size_t first = length[0] > length[1] ? 0 : 1;
  return RowSides{std::move(sides[first]), std::move(sides[first + 2]), {sides[1 - first], sides[3 - first]}};
}

BrepFace withEnds(BrepFace face) { return withCorners(std::move(face), 4); }

bool isTinyTriangle(const BrepFace& face, const std::vector<double>& wanted) {
  if (face.loops.size() != 1 || face.loops[0].coedges.size() != 3) return false;
  const auto& coedges = face.loops[0].coedges;
  return std::all_of(coedges.begin(), coedges.end(), [&](const Coedge& coedge) {
    return coedge.cornerQuads == 1 && wanted[static_cast<std::size_t>(coedge.edge)] < 1.0;
  });
}

bool suitsOdd(const Brep& brep, const BrepFace& face, const std::vector<double>& wanted) {
  if (isTinyTriangle(face, wanted)) return true;
  const std::optional<RowSides> tapered = taperedSides(face);
  return tapered && !tapered->ends.empty() && rowsAcross(brep, face, wanted) < kOneRow;
}

}  // namespace qmcf
