#include "edge_groups.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

namespace qmcf {
namespace {

/// Two edges that should match, and how much they may differ to be matched.
struct Opposites {
  std::int32_t first = kNone;
  std::int32_t second = kNone;
  double mostRatio = 1.0;
};

bool alike(double a, double b, double mostRatio) {
  constexpr double kDifference = 1.0;
  return std::fabs(a - b) < kDifference || std::max(a, b) < mostRatio * std::min(a, b);
}

/// The single edges between the four corners of a face, or nothing.
std::optional<std::array<std::int32_t, 4>> sidesOf(const BrepFace& face) {
  if (face.loops.size() != 1 || face.loops[0].coedges.size() != 4) return std::nullopt;
  std::array<std::int32_t, 4> sides{};
  for (std::size_t c = 0; c < 4; ++c) {
    const Coedge& coedge = face.loops[0].coedges[c];
    if (coedge.cornerQuads != 1) return std::nullopt;
    sides[c] = coedge.edge;
  }
  return sides;
}

bool isRing(const Brep& brep, const BrepFace& face) {
  if (face.loops.size() != 2) return false;
  return std::all_of(face.loops.begin(), face.loops.end(), [&](const BrepLoop& loop) {
    if (loop.coedges.size() != 1) return false;
    const BrepEdge& edge = brep.edges[static_cast<std::size_t>(loop.coedges[0].edge)];
    return edge.start == edge.end;
  });
}

/// In a strip of one or two rows there is no room to change the number of elements from one side to the other.
double mostRatio(const Brep& brep, const std::vector<double>& wanted, const BrepFace& face, std::int32_t a,
                 std::int32_t b) {
  constexpr double kWide = 1.15;
  constexpr double kNarrow = 1.7;
  constexpr double kRows = 2.0;
  const auto sum = [a, b](const auto& of) { return of(static_cast<std::size_t>(a)) + of(static_cast<std::size_t>(b)); };
  const double length = sum([&](std::size_t e) { return brep.edges[e].length; });
  const double count = sum([&](std::size_t e) { return wanted[e]; });
  const double width = 2.0 * face.area / length;
  return width < kRows * length / count ? kNarrow : kWide;
}

}  // namespace

std::vector<std::vector<std::int32_t>> oppositeEdges(const Brep& brep, const std::vector<double>& wanted) {
  std::vector<Opposites> pairs;
  const auto add = [&](const BrepFace& face, std::int32_t a, std::int32_t b) {
    pairs.push_back({a, b, mostRatio(brep, wanted, face, a, b)});
  };
  for (const BrepFace& face : brep.faces) {
    if (const auto sides = sidesOf(face)) {
      add(face, (*sides)[0], (*sides)[2]);
      add(face, (*sides)[1], (*sides)[3]);
    } else if (isRing(brep, face)) {
      add(face, face.loops[0].coedges[0].edge, face.loops[1].coedges[0].edge);
    }
  }
  std::vector<std::int32_t> root(brep.edges.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](std::int32_t e) {
    while (root[static_cast<std::size_t>(e)] != e) {
      std::int32_t& up = root[static_cast<std::size_t>(e)];
      up = root[static_cast<std::size_t>(up)];
      e = up;
    }
    return e;
  };
  for (const Opposites& pair : pairs) {
    const std::int32_t ra = find(pair.first);
    const std::int32_t rb = find(pair.second);
    // Alike to each other and to the first of either group, so that a long row of faces can't drift.
    const auto fit = [&](std::int32_t e, std::int32_t f) {
      return alike(wanted[static_cast<std::size_t>(e)], wanted[static_cast<std::size_t>(f)], pair.mostRatio);
    };
    if (ra == rb || !fit(pair.first, pair.second) || !fit(ra, rb)) continue;
    root[static_cast<std::size_t>(std::max(ra, rb))] = std::min(ra, rb);
  }
  std::vector<std::vector<std::int32_t>> members(brep.edges.size());
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const auto edge = static_cast<std::int32_t>(e);
    members[static_cast<std::size_t>(find(edge))].push_back(edge);
  }
  std::vector<std::vector<std::int32_t>> groups;
  for (auto& group : members) {
    if (group.size() > 1) groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace qmcf
