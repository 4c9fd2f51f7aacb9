// Fields in the metric of sizes that vary from place to place (A9 of docs/algorithm.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "field/patches.hpp"
#include "field/solve.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/field/connection.hpp"

namespace qmcf {
namespace {

using testing::solve;

double radiusOf(const Vec3& p) { return std::hypot(p.x, p.y); }

/// The square [-1, 1]^2 with a round hole in its middle.
Patch plateWithHole(double radius) {
  testing::Grid grid;
  grid.nx = 48;
  grid.ny = 40;
  grid.closedX = true;
  grid.map = [radius](double x, double y) {
    const double angle = -2.0 * std::numbers::pi * x;
    const double edge = 1.0 / std::max(std::fabs(std::cos(angle)), std::fabs(std::sin(angle)));
    const double r = radius * std::pow(edge / radius, y);
    return Vec3{r * std::cos(angle), r * std::sin(angle), 0.0};
  };
  return testing::makeGrid(grid, 0.3);
}

/// Eight elements around the hole, of a constant size from where these have grown to it.
void growAroundHole(Patch& patch, double size) {
  for (const VertexId v : patch.surface.vertices()) {
    patch.size[v] = std::min(size, std::numbers::pi / 4.0 * radiusOf(patch.surface.position(v)));
  }
}

FieldOptions inSpace() {
  FieldOptions options;
  options.followSizes = false;
  return options;
}

TEST(GrowingSizes, ThatAreTheSameEverywhereChangeNothing) {
  const Patch patch = testing::makeDisk(8);
  const CrossField field = solve(patch);
  const CrossField same = solve(patch, inSpace());
  for (const VertexId v : patch.surface.vertices()) EXPECT_EQ(field.cross[v], same.cross[v]);
  Connection connection = buildConnection(patch);
  followSizes(patch, connection);
  EXPECT_TRUE(connection.growth.empty());
}

TEST(GrowingSizes, KeepTheTurnOfTheWholePatch) {
  // What a direction turns around all triangles depends on the patch's shape alone (Gauss-Bonnet).
  Patch patch = plateWithHole(0.1);
  Connection connection = buildConnection(patch);
  double before = 0.0;
  for (const TriangleId t : patch.surface.triangles()) before += triangleCurvature(connection, t);
  growAroundHole(patch, 0.3);
  followSizes(patch, connection);
  double after = 0.0;
  for (const TriangleId t : patch.surface.triangles()) after += triangleCurvature(connection, t);
  EXPECT_NEAR(after, before, 1e-9);
  for (const HalfedgeId h : patch.surface.halfedges()) {
    const HalfedgeId back = patch.surface.twin(h);
    EXPECT_EQ(connection.growth[h], back.valid() ? -connection.growth[back] : 0.0);
  }
}

TEST(GrowingSizes, AroundAMiddleMakeCirclesAndRaysStraight) {
  // The edges of a sector turn by a right angle; squares that are as long as they are far from the middle don't.
  testing::Grid grid;
  grid.nx = 24;
  grid.ny = 12;
  grid.map = [](double x, double y) {
    const double angle = 0.5 * std::numbers::pi * (1.0 - x);
    return Vec3{(1.0 + y) * std::cos(angle), (1.0 + y) * std::sin(angle), 0.0};
  };
  Patch sector = testing::makeGrid(grid, 0.1);
  const double energyInSpace = solve(sector).energy;
  for (const VertexId v : sector.surface.vertices()) sector.size[v] = 0.1 * radiusOf(sector.surface.position(v));
  const CrossField field = solve(sector);
  EXPECT_LT(field.energy, 0.02 * energyInSpace);
  for (const TriangleId t : sector.surface.triangles()) {
    for (const std::array<double, 3>& at : {std::array{0.6, 0.3, 0.1}, std::array{0.1, 0.2, 0.7}}) {
      const SurfacePoint point{t, at};
      const Vec3 p = positionOf(sector.surface, point);
      double off = 2.0;
      for (const Vec3& d : crossDirections(sector.surface, field, point)) {
        off = std::min(off, norm(d - Vec3{p.x, p.y, 0.0} / radiusOf(p)));
      }
      EXPECT_LT(off, 0.03);
    }
  }
}

TEST(GrowingSizes, KeepSingularitiesAwayFromSmallHoles) {
  // The rings around a hole need not end where space is flat again, but where elements have their full size, 0.38 from
  // the middle.
  constexpr double kRadius = 0.05;
  Patch patch = plateWithHole(kRadius);
  const auto nearest = [](const Patch& on, const CrossField& field) {
    double least = 1e9;
    for (const Singularity& singularity : field.singularities) {
      EXPECT_EQ(singularity.index, -1);
      least = std::min(least, radiusOf(positionOf(on.surface, singularity.point)));
    }
    EXPECT_EQ(field.singularities.size(), 4U);
    return least;
  };
  growAroundHole(patch, 0.3);
  EXPECT_LT(nearest(patch, solve(patch, inSpace())), 2.0 * kRadius);
  EXPECT_NEAR(nearest(patch, solve(patch)), 0.3 / (std::numbers::pi / 4.0), 0.02);
}

TEST(GrowingSizes, OfAnyKindKeepTheIndices) {
  // Sizes that jump from one vertex to the next are nobody's wish; Gauss-Bonnet holds all the same.
  for (int seed = 1; seed <= 8; ++seed) {
    Patch patch = seed % 2 == 0 ? testing::makeSphere(16) : testing::makeSquare(24);
    std::uint32_t state = static_cast<std::uint32_t>(seed) * 2654435761U;
    for (double& size : patch.size.raw()) {
      state = state * 1664525U + 1013904223U;
      size = 0.05 * std::exp2(static_cast<double>(state >> 24U) / 128.0);
    }
    EXPECT_EQ(gaussBonnetDefect(patch, solve(patch)), 0) << seed;
  }
}

}  // namespace
}  // namespace qmcf
