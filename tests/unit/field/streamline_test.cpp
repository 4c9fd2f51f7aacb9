#include "qmcf/field/streamline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "field/patches.hpp"
#include "field/solve.hpp"

namespace qmcf {
namespace {

using testing::solve;

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

}  // namespace
}  // namespace qmcf
