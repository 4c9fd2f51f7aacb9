#include "qmcf/field/even_streamlines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "field/patches.hpp"

namespace qmcf {
namespace {

using Lines = std::vector<std::vector<Vec3>>;

Lines draw(const Patch& patch, double spacing) {
  SilentProgress progress;
  const Result<CrossField> field = computeCrossField(patch, {}, {}, progress);
  EXPECT_TRUE(field.ok());
  return evenStreamlines(patch, field.value(), spacing);
}

double pointToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double f = std::clamp(dot(p - a, b - a) / squaredNorm(b - a), 0.0, 1.0);
  return distance(p, a + (b - a) * f);
}

/// The distance from a point to the nearest line whose direction there is within 45 degrees of `along`, up to the sign.
double nearestAlong(const Lines& lines, const Vec3& p, const Vec3& along, std::size_t except) {
  double nearest = 1e300;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    for (std::size_t i = 0; l != except && i + 1 < lines[l].size(); ++i) {
      const Vec3 direction = normalized(lines[l][i + 1] - lines[l][i]);
      if (std::fabs(dot(direction, along)) < 0.75) continue;
      nearest = std::min(nearest, pointToSegment(p, lines[l][i], lines[l][i + 1]));
    }
  }
  return nearest;
}

TEST(EvenStreamlines, OfSquareAreAGrid) {
  const Lines lines = draw(testing::makeSquare(20), 0.1);
  int across = 0;
  int upwards = 0;
  for (const auto& line : lines) {
    const Vec3 span = line.back() - line.front();
    EXPECT_NEAR(norm(span), 1.0, 1e-6);
    EXPECT_NEAR(std::min(std::fabs(span.x), std::fabs(span.y)), 0.0, 1e-6);
    ++(std::fabs(span.x) > 0.5 ? across : upwards);
  }
  // With vertices every 0.05 rows are 0.1 or, where rounding blocks the next one, 0.15 apart.
  for (const int rows : {across, upwards}) {
    EXPECT_GE(rows, 7);
    EXPECT_LE(rows, 11);
  }
}

TEST(EvenStreamlines, OfTorusKeepTheirDistanceAndCoverIt) {
  const double spacing = 0.15;
  const Patch patch = testing::makeTorus(96, 48);
  const Lines lines = draw(patch, spacing);
  ASSERT_GT(lines.size(), 10U);
  for (std::size_t l = 0; l < lines.size(); ++l) {
    for (std::size_t i = 0; i + 2 < lines[l].size(); i += 5) {
      const Vec3 direction = normalized(lines[l][i + 1] - lines[l][i]);
      EXPECT_GT(nearestAlong(lines, lines[l][i], direction, l), 0.35 * spacing);
    }
  }
  for (const VertexId v : patch.surface.vertices()) {
    if (v.value % 37 != 0) continue;
    const Vec3 p = patch.surface.position(v);
    const Vec3 radial = normalized(Vec3{p.x, p.y, 0.0});
    const Vec3 around{-radial.y, radial.x, 0.0};
    const Vec3 other = cross(patch.normal[v], around);
    for (const Vec3& along : {around, other}) EXPECT_LT(nearestAlong(lines, p, along, lines.size()), 1.05 * spacing);
  }
}

}  // namespace
}  // namespace qmcf
