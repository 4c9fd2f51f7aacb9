#include "qmcf/mesh/side_pattern.hpp"

#include <gtest/gtest.h>

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

void expectRegular(const std::vector<int>& sides) {
  SCOPED_TRACE(::testing::PrintToString(sides));
  const auto [loop, corners] = polygon(sides);
  const auto pattern = fillSides(loop, corners);
  ASSERT_TRUE(pattern.has_value());
  const int count = static_cast<int>(loop.size() + pattern->inner.size());
  std::vector<int> valence(static_cast<std::size_t>(count), 0);
  std::map<std::pair<int, int>, int> directed;
  double area = 0.0;
  const auto position = [&](int v) {
    return v < static_cast<int>(loop.size()) ? loop[static_cast<std::size_t>(v)]
                                             : pattern->inner[static_cast<std::size_t>(v) - loop.size()];
  };
  for (const auto& cell : pattern->cells) {
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_GE(cell[i], 0);
      ASSERT_LT(cell[i], count);
      ++valence[static_cast<std::size_t>(cell[i])];
      EXPECT_EQ(++directed[std::pair(cell[i], cell[(i + 1) % 4])], 1);
    }
    const double own = 0.5 * cross(position(cell[2]) - position(cell[0]), position(cell[3]) - position(cell[1])).z;
    EXPECT_GT(own, 0.0);
    area += own;
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
  const auto n = static_cast<double>(sides.size());
  EXPECT_NEAR(area, 0.5 * n * math::sin(2.0 * math::kPi / n), 1e-12);
  std::size_t next = 0;
  for (int v = 0; v < static_cast<int>(loop.size()); ++v) {
    const bool isCorner = next < corners.size() && corners[next] == v;
    if (isCorner) ++next;
    EXPECT_EQ(valence[static_cast<std::size_t>(v)], isCorner ? 1 : 2);
  }
  int irregular = 0;
  for (std::size_t v = loop.size(); v < valence.size(); ++v) {
    if (valence[v] == 4) continue;
    ++irregular;
    EXPECT_EQ(valence[v], static_cast<int>(sides.size()));
  }
  EXPECT_EQ(irregular, sides.size() == 4 ? 0 : 1);
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

}  // namespace
}  // namespace qmcf
