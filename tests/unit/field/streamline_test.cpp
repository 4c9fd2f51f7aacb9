#include "qmcf/field/streamline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "field/patches.hpp"
#include "qmcf/field/spaced_streamlines.hpp"

namespace qmcf {
namespace {

CrossField solve(const Patch& patch) {
  SilentProgress progress;
  Result<CrossField> field = computeCrossField(patch, {}, {}, progress);
  EXPECT_TRUE(field.ok());
  return std::move(field).value();
}

TEST(Streamline, CrossesSquareStraight) {
  const Patch patch = testing::makeSquare(10);
  const Surface& surface = patch.surface;
  const CrossField field = solve(patch);
  const SurfacePoint start{TriangleId(90), {0.2, 0.5, 0.3}};
  const Vec3 from = positionOf(surface, start);
  const Streamline up = traceStreamline(surface, field, start, {0.1, 1.0, 0.0}, {});
  EXPECT_EQ(up.end, StreamlineEnd::boundary);
  EXPECT_NEAR(up.length, 1.0 - from.y, 1e-9);
  for (const SurfacePoint& p : up.points) EXPECT_NEAR(positionOf(surface, p).x, from.x, 1e-7);

  const Streamline part = traceStreamline(surface, field, start, {1.0, 0.2, 0.0}, {.length = 0.25});
  EXPECT_EQ(part.end, StreamlineEnd::length);
  EXPECT_NEAR(positionOf(surface, part.points.back()).x, from.x + 0.25, 1e-7);
}

TEST(Streamline, StartsAtAnyCornerOfTheFan) {
  const Patch patch = testing::makeSquare(8);
  const Surface& surface = patch.surface;
  const CrossField field = solve(patch);
  for (const TriangleId t : surface.triangles()) {
    for (std::size_t c = 0; c < 3; ++c) {
      SurfacePoint start{t, {0.0, 0.0, 0.0}};
      start.barycentric[c] = 1.0;
      const Vec3 from = positionOf(surface, start);
      if (surface.isBoundary(surface.corners(t)[c])) continue;
      const Streamline line = traceStreamline(surface, field, start, {-1.0, 0.0, 0.0}, {});
      EXPECT_EQ(line.end, StreamlineEnd::boundary);
      EXPECT_NEAR(line.length, from.x, 1e-6);
    }
  }
}

TEST(Streamline, ClosesAroundCylinder) {
  const Patch patch = testing::makeCylinder(48, 24, 3.0, 0.9);
  const CrossField field = solve(patch);
  const SurfacePoint start{TriangleId(1000), {0.4, 0.3, 0.3}};
  const Vec3 from = positionOf(patch.surface, start);
  const Vec3 around = normalized(Vec3{-from.y, from.x, 0.0});
  const double turn = 96.0 * std::sin(std::numbers::pi / 48.0);  // of the inscribed polygon
  const Streamline line = traceStreamline(patch.surface, field, start, around, {.length = turn});
  EXPECT_EQ(line.end, StreamlineEnd::length);
  EXPECT_LT(distance(positionOf(patch.surface, line.points.back()), from), 0.02);
}

TEST(SpacedStreamlines, CoverSquareWithBothFamilies) {
  const Patch patch = testing::makeSquare(20);
  const double spacing = 3.0 / 20;
  const std::vector<Streamline> lines = spacedStreamlines(patch, solve(patch), {.spacing = 3.0});
  std::array<std::vector<double>, 2> places;  // x of the vertical lines, y of the horizontal ones
  for (const Streamline& line : lines) {
    const Vec3 a = positionOf(patch.surface, line.points.front());
    const Vec3 b = positionOf(patch.surface, line.points.back());
    EXPECT_NEAR(line.length, 1.0, 1e-6);  // From side to side.
    EXPECT_NEAR(distance(a, b), 1.0, 1e-6);
    if (std::fabs(a.x - b.x) < 1e-6) {
      places[0].push_back(a.x);
    } else {
      places[1].push_back(a.y);
    }
  }
  for (std::vector<double>& family : places) {
    std::sort(family.begin(), family.end());
    ASSERT_GE(family.size(), 4U);
    EXPECT_LT(family.front(), spacing);
    EXPECT_GT(family.back(), 1.0 - spacing);
    for (std::size_t i = 1; i < family.size(); ++i) {
      EXPECT_GT(family[i] - family[i - 1], 0.99 * spacing);
      EXPECT_LT(family[i] - family[i - 1], 2.01 * spacing);
    }
  }
}

TEST(SpacedStreamlines, RunAroundTorusOnce) {
  const Patch patch = testing::makeTorus(60, 24, 0.4);
  const std::vector<Streamline> lines = spacedStreamlines(patch, solve(patch), {.spacing = 3.0});
  ASSERT_GE(lines.size(), 10U);
  for (const Streamline& line : lines) EXPECT_LT(line.length, 1.1 * 2.0 * std::numbers::pi * 1.4);
}

}  // namespace
}  // namespace qmcf
