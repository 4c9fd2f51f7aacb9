#include "qmcf/quality/turned_over.hpp"

#include <gtest/gtest.h>

namespace qmcf {
namespace {

/// A steep roof of two triangles with its ridge on the y axis; first: which side comes first.
TriangleBvh roof(std::size_t first) {
  const std::vector<Vec3> positions{{0, -40, 0}, {0, 40, 0}, {-10, 0, -40}, {10, 0, -40}};
  const std::array<std::array<std::int32_t, 3>, 2> sides{{{1, 2, 0}, {0, 3, 1}}};
  return {positions, {sides[first], sides[1 - first]}};
}

double turnedOverBy(const TriangleBvh& surface, const std::array<Vec3, 4>& quad) {
  return qmcf::turnedOverBy(surface, quad, 4, surface.closest((quad[0] + quad[1] + quad[2] + quad[3]) * 0.25));
}

TEST(TurnedOver, CornerAgainstOneOfTheTrianglesBelowTheCentreCounts) {
  // The centre is above the ridge. The first corner is on the left side of the roof and faces against that, but not
  // against the other side, which is as near to the centre.
  const Vec3 centre{0, 0, 0.5};
  const std::array<Vec3, 3> known{Vec3{-1, 0, -3.9}, Vec3{-1, 1, -3.9}, Vec3{-1.2, 0, -1.9}};
  const Vec3 opposite = centre * 4.0 - known[0] - known[1] - known[2];
  for (const std::size_t first : {0U, 1U}) {
    const double by = turnedOverBy(roof(first), {known[0], known[1], opposite, known[2]});
    EXPECT_GT(by, 0.0) << first;
    EXPECT_LE(by, 1.0) << first;
  }
}

TEST(TurnedOver, ElementsOnTheSurfaceAreUpright) {
  for (const std::size_t first : {0U, 1U}) {
    const TriangleBvh surface = roof(first);
    const std::array<Vec3, 4> left{Vec3{-1, -1, -4}, {0, -1, 0}, {0, 1, 0}, {-1, 1, -4}};
    const std::array<Vec3, 4> across{Vec3{-0.1, -1, -0.4}, {0.1, -1, -0.4}, {0.1, 1, -0.4}, {-0.1, 1, -0.4}};
    EXPECT_EQ(turnedOverBy(surface, left), 0.0);
    EXPECT_EQ(turnedOverBy(surface, across), 0.0);
    EXPECT_GT(turnedOverBy(surface, {left[3], left[2], left[1], left[0]}), 0.2);
  }
}

}  // namespace
}  // namespace qmcf
