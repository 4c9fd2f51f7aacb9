#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "field/patches.hpp"
#include "qmcf/field/cross_field.hpp"

namespace qmcf {
namespace {

CrossField solve(const Patch& patch, const FieldOptions& options = {}) {
  SilentProgress progress;
  Result<CrossField> field = computeCrossField(patch, {}, options, progress);
  EXPECT_TRUE(field.ok());
  return std::move(field).value();
}

TEST(PlanarField, HasNoSingularityWhereRightAnglesNeedNone) {
  const auto flat = [](double x, double y) { return Vec3{x, y, 0.0}; };
  const auto inL = [](double x, double y) { return x < 0.5 || y < 0.5; };
  const auto framed = [](double x, double y) { return x < 0.25 || x > 0.75 || y < 0.375 || y > 0.625; };
  for (const Patch& patch :
       {testing::makeSquare(9), testing::makeGrid({.nx = 12, .ny = 12, .map = flat, .keep = inL}, 1.0 / 12),
        testing::makeGrid({.nx = 16, .ny = 16, .map = flat, .keep = framed}, 1.0 / 16)}) {
    const CrossField field = solve(patch);
    EXPECT_TRUE(field.singularities.empty());
    EXPECT_EQ(gaussBonnetDefect(patch, field), 0);
    for (const TriangleId t : patch.surface.triangles()) {
      const Vec3 d = crossDirections(patch.surface, field, {t, {0.3, 0.3, 0.4}})[0];
      EXPECT_NEAR(std::min(std::fabs(d.x), std::fabs(d.y)), 0.0, 1e-9);
    }
  }
}

TEST(PlanarField, OfDiskHasFourSingularitiesNearTheRim) {
  for (const int rings : {10, 20, 40, 90}) {  // Solved directly, from clusters, and by conjugate gradients.
    const Patch patch = testing::makeDisk(rings);
    const CrossField field = solve(patch);
    ASSERT_EQ(field.singularities.size(), 4U) << rings;
    for (const Singularity& s : field.singularities) {
      EXPECT_EQ(s.index, 1);
      EXPECT_GT(norm(positionOf(patch.surface, s.point)), 0.6);
      EXPECT_LT(crossConfidence(field, s.point), 1e-9);
    }
  }
}

TEST(PlanarField, OfPentagonWithRoundHoleHasFiveSingularities) {
  const Patch patch = testing::makePolygonRing(5, 12, 10, true);
  const CrossField field = solve(patch);
  EXPECT_EQ(gaussBonnetDefect(patch, field), 0);
  ASSERT_EQ(field.singularities.size(), 5U);
  for (const Singularity& s : field.singularities) EXPECT_EQ(s.index, -1);
}

TEST(PlanarField, OfPentagonWithPentagonalHoleHasItsSingularitiesAtTheCornersOfTheHole) {
  const Patch patch = testing::makePolygonRing(5, 12, 10, false);
  const CrossField field = solve(patch);
  EXPECT_EQ(gaussBonnetDefect(patch, field), 0);
  EXPECT_TRUE(field.singularities.empty());
}

TEST(PlanarField, FollowsEveryBoundaryEdge) {
  // 78 and 102 degrees at the corners: no cross fits both edges there, yet each edge is met exactly.
  const auto skew = [](double x, double y) { return Vec3{x + 0.2 * y, y, 0.0}; };
  for (const Patch& patch : {testing::makeGrid({.nx = 7, .ny = 6, .map = skew, .keep = {}}, 1.0 / 7),
                             testing::makePolygonRing(5, 6, 5, false)}) {
    const Surface& surface = patch.surface;
    const CrossField field = solve(patch);
    for (const HalfedgeId h : surface.halfedges()) {
      const TriangleId t = Surface::triangle(h);
      const bool cornerTriangle = surface.isBoundary(Surface::next(h)) || surface.isBoundary(Surface::prev(h));
      if (!surface.isBoundary(h) || cornerTriangle) continue;
      const Vec3 along = normalized(surface.position(surface.target(h)) - surface.position(surface.origin(h)));
      for (const double f : {0.0, 0.3, 1.0}) {
        SurfacePoint point{t, {0.0, 0.0, 0.0}};
        point.barycentric[static_cast<std::size_t>(h.value % 3)] = 1.0 - f;
        point.barycentric[static_cast<std::size_t>(Surface::next(h).value % 3)] = f;
        double best = 0.0;
        for (const Vec3& d : crossDirections(surface, field, point)) best = std::max(best, dot(d, along));
        EXPECT_NEAR(best, 1.0, 1e-12);
      }
    }
  }
}

TEST(PlanarField, FollowsTheTangentsOfACircleCutIntoChords) {
  const Patch patch = testing::makeDisk(6);
  const Surface& surface = patch.surface;
  const CrossField field = solve(patch);
  for (const HalfedgeId h : surface.halfedges()) {
    const TriangleId t = Surface::triangle(h);
    for (int c = 0; c < 3; ++c) {
      const VertexId v = surface.corners(t)[static_cast<std::size_t>(c)];
      if (!surface.isBoundary(v)) continue;
      SurfacePoint point{t, {0.0, 0.0, 0.0}};
      point.barycentric[static_cast<std::size_t>(c)] = 1.0;
      double best = 0.0;
      for (const Vec3& d : crossDirections(surface, field, point)) best = std::max(best, dot(d, surface.position(v)));
      EXPECT_NEAR(best, 1.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace qmcf
