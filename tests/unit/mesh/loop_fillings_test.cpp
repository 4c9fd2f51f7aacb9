#include "qmcf/mesh/loop_fillings.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace qmcf {
namespace {

TEST(LoopFillings, WithoutNewVertexAreCountedByTheFussCatalanNumbers) {
  const std::map<int, int> quadrangulations{{4, 1}, {6, 3}, {8, 12}, {10, 55}};
  for (const auto& [length, expected] : quadrangulations) {
    int plain = 0;
    for (const LoopFilling& way : loopFillings(length)) plain += way.hasMiddle ? 0 : 1;
    EXPECT_EQ(plain, expected) << length;
  }
  EXPECT_TRUE(loopFillings(5).empty());
  EXPECT_TRUE(loopFillings(12).empty());
}

TEST(LoopFillings, FormADiskWithTheLoopAsBoundary) {
  for (const int length : {4, 6, 8, 10}) {
    std::set<std::set<std::array<int, 4>>> seen;
    for (const LoopFilling& way : loopFillings(length)) {
      std::map<std::pair<int, int>, int> directed;
      std::set<int> vertices;
      for (const auto& cell : way.cells) {
        for (std::size_t i = 0; i < 4; ++i) {
          ++directed[{cell[i], cell[(i + 1) % 4]}];
          vertices.insert(cell[i]);
        }
      }
      int border = 0;
      for (const auto& [edge, uses] : directed) {
        EXPECT_EQ(uses, 1);
        if (directed.count({edge.second, edge.first}) == 0) {
          EXPECT_EQ(edge.second, (edge.first + 1) % length);
          ++border;
        }
      }
      EXPECT_EQ(border, length);
      EXPECT_EQ(static_cast<int>(vertices.size()), length + (way.hasMiddle ? 1 : 0));
      const int edges = (static_cast<int>(directed.size()) + border) / 2;
      EXPECT_EQ(static_cast<int>(vertices.size()) - edges + static_cast<int>(way.cells.size()), 1);
      EXPECT_TRUE(seen.insert({way.cells.begin(), way.cells.end()}).second) << "a way occurs twice";
    }
  }
}

}  // namespace
}  // namespace qmcf
