#include "qmcf/mesh/side_pattern.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

/// A regular polygon whose sides have these numbers of edges; the corners start the sides.
std::pair<std::vector<Vec3>, std::vector<int>> polygon(const std::vector<int>& sides) {
  std::vector<Vec3> corner;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto u = math::unitComplex(2.0 * math::kPi * static_cast<double>(i) / static_cast<double>(sides.size()));
    corner.push_back({u.real(), u.imag(), 0.0});
  }
  std::vector<Vec3> loop;
  std::vector<int> starts;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    starts.push_back(static_cast<int>(loop.size()));
    const Vec3& next = corner[(i + 1) % sides.size()];
    for (int k = 0; k < sides[i]; ++k)
      loop.push_back(corner[i] + (next - corner[i]) * (static_cast<double>(k) / sides[i]));
  }
  return {loop, starts};
}

/// Checks that the pattern fills the polygon: conforming, counter-clockwise, of the polygon's area, one cell at its
/// corners and two elsewhere on its outline. Returns how many cells its irregular inner vertices have, ascending.
std::vector<int> expectFills(const SidePattern& pattern, const std::vector<Vec3>& loop,
                             const std::vector<int>& corners) {
  const int count = static_cast<int>(loop.size() + pattern.inner.size());
  std::vector<int> valence(static_cast<std::size_t>(count), 0);
  std::map<std::pair<int, int>, int> directed;
  const auto position = [&](int v) {
    return v < static_cast<int>(loop.size()) ? loop[static_cast<std::size_t>(v)]
                                             : pattern.inner[static_cast<std::size_t>(v) - loop.size()];
  };
  double area = 0.0;
  for (const auto& cell : pattern.cells) {
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_GE(cell[i], 0);
      EXPECT_LT(cell[i], count);
      if (cell[i] < 0 || cell[i] >= count) return {};
      ++valence[static_cast<std::size_t>(cell[i])];
      EXPECT_EQ(++directed[std::pair(cell[i], cell[(i + 1) % 4])], 1);
    }
    area += 0.5 * cross(position(cell[2]) - position(cell[0]), position(cell[3]) - position(cell[1])).z;
  }
  // Every loop edge is used once, forwards; all others in both directions.
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto a = static_cast<int>(i);
    const auto b = static_cast<int>((i + 1) % loop.size());
    EXPECT_EQ(directed.count({a, b}), 1U);
    EXPECT_EQ(directed.count({b, a}), 0U);
    directed.erase({a, b});
  }
  for (const auto& [edge, uses] : directed) EXPECT_EQ(directed.count({edge.second, edge.first}), 1U);
  double whole = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) whole += 0.5 * cross(loop[i], loop[(i + 1) % loop.size()]).z;
  EXPECT_NEAR(area, whole, 1e-12);
  for (int v = 0; v < static_cast<int>(loop.size()); ++v) {
    const bool isCorner = std::find(corners.begin(), corners.end(), v) != corners.end();
    EXPECT_EQ(valence[static_cast<std::size_t>(v)], isCorner ? 1 : 2);
  }
  std::vector<int> irregular;
  for (std::size_t v = loop.size(); v < valence.size(); ++v) {
    if (valence[v] != 4) irregular.push_back(valence[v]);
  }
  std::sort(irregular.begin(), irregular.end());
  return irregular;
}

void expectRegular(const std::vector<int>& sides) {
  SCOPED_TRACE(::testing::PrintToString(sides));
  const auto [loop, corners] = polygon(sides);
  const auto pattern = fillSides(loop, corners);
  ASSERT_TRUE(pattern.has_value());
  const auto k = static_cast<int>(sides.size());
  EXPECT_EQ(expectFills(*pattern, loop, corners), k == 4 ? std::vector<int>{} : std::vector<int>{k});
  const auto position = [&, inner = pattern->inner](int v) {
    const auto i = static_cast<std::size_t>(v);
    return i < loop.size() ? loop[i] : inner[i - loop.size()];
  };
  for (const auto& cell : pattern->cells) {
    EXPECT_GT(cross(position(cell[2]) - position(cell[0]), position(cell[3]) - position(cell[1])).z, 0.0);
  }
}

TEST(SidePattern, FillsFourSidesWithAGrid) {
  expectRegular({1, 1, 1, 1});
  expectRegular({3, 5, 3, 5});
}

TEST(SidePattern, FillsThreeAndFiveSidesAroundOneVertex) {
  expectRegular({2, 2, 2});
  expectRegular({4, 3, 5});
  expectRegular({2, 2, 2, 2, 2});
  expectRegular({3, 4, 4, 4, 3});
}

TEST(SidePattern, RefusesSidesThatDoNotFit) {
  for (const std::vector<int>& sides :
       std::vector<std::vector<int>>{{2, 3, 3, 3}, {2, 2, 3}, {2, 2, 4}, {2, 2}, {9, 2, 2, 2, 3}}) {
    const auto [loop, corners] = polygon(sides);
    EXPECT_FALSE(fillSides(loop, corners).has_value()) << ::testing::PrintToString(sides);
  }
}

void expectTwo(const std::vector<Vec3>& loop, const std::vector<int>& corners, const std::vector<int>& valences) {
  constexpr std::size_t kMost = 5;
  const std::vector<SideCut> cuts = cutsInTwo(loop, corners, kMost);
  ASSERT_FALSE(cuts.empty());
  EXPECT_LE(cuts.size(), kMost);
  for (const SideCut& cut : cuts) {
    const SidePattern pattern = fillCut(loop, corners, cut);
    EXPECT_EQ(expectFills(pattern, loop, corners), valences);
    EXPECT_EQ(pattern.cells.size(), static_cast<std::size_t>(cut.cells));
  }
}

TEST(SidePattern, FillsFourUnequalSidesWithAThreeAndAFive) {
  for (const std::vector<int>& sides :
       std::vector<std::vector<int>>{{6, 6, 7, 7}, {6, 5, 8, 5}, {9, 6, 6, 5}, {3, 2, 2, 3}, {12, 7, 9, 8}}) {
    SCOPED_TRACE(::testing::PrintToString(sides));
    const auto [loop, corners] = polygon(sides);
    expectTwo(loop, corners, {3, 5});
  }
}

TEST(SidePattern, FillsSixSidesWithTwoFives) {
  const auto [loop, corners] = polygon({4, 4, 4, 4, 4, 4});
  expectTwo(loop, corners, {5, 5});
}

TEST(SidePattern, FillsALensWithTwoThrees) {
  // Two arcs of eight edges.
  constexpr int kEdges = 8;
  std::vector<Vec3> loop;
  for (int i = 0; i < kEdges; ++i)
    loop.push_back({-1.0 + 2.0 * i / kEdges, -0.7 * math::sin(math::kPi * i / kEdges), 0});
  for (int i = 0; i < kEdges; ++i) loop.push_back({1.0 - 2.0 * i / kEdges, 0.7 * math::sin(math::kPi * i / kEdges), 0});
  expectTwo(loop, {0, kEdges}, {3, 3});
}

TEST(SidePattern, HasNoTwoForOddLoopsAndOtherNumbersOfSides) {
  for (const std::vector<int>& sides :
       std::vector<std::vector<int>>{{5, 5, 5, 6}, {5, 5, 5, 5}, {4, 4, 4}, {4, 4, 4, 4, 4}, {1, 1, 1, 1}}) {
    const auto [loop, corners] = polygon(sides);
    EXPECT_TRUE(cutsInTwo(loop, corners, 5).empty()) << ::testing::PrintToString(sides);
  }
}

}  // namespace
}  // namespace qmcf
