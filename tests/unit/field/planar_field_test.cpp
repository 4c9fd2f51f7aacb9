#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "field/patches.hpp"
#include "field/solve.hpp"
#include "qmcf/field/cross_field.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {
namespace {

using testing::solve;

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

TEST(PlanarField, OfPentagonWithPentagonalHoleHasFiveSingularitiesInsideIfTheHoleMayHaveNone) {
  // Two quads wanted at the corners of the hole, as gmsh's thresholds would have it: nothing is left to the corners.
  for (const FieldSolver solver : {FieldSolver::eliminate, FieldSolver::leastSquares}) {
    Patch patch = testing::makePolygonRing(5, 16, 14, false);
    for (const VertexId v : patch.surface.vertices()) {
      if (patch.cornerQuads[v] == 3) patch.cornerQuads[v] = 2;
    }
    FieldOptions options;
    options.solver = solver;
    const CrossField field = solve(patch, options);
    ASSERT_EQ(field.singularities.size(), 5U);
    for (const Singularity& s : field.singularities) EXPECT_EQ(s.index, -1);
    EXPECT_EQ(gaussBonnetDefect(patch, field), 0);
  }
}

// The disk's harmonic field with u = e^(4 i phi) on the rim is r^4 e^(4 i phi); that of least squares is biharmonic and
// clamped, which makes it (3 r^4 - 2 r^6) e^(4 i phi): it holds the rim's direction deeper inwards.
TEST(PlanarField, OfDiskHasTheMagnitudeThatItsLinearSystemDemands) {
  const Patch patch = testing::makeDisk(40);
  const auto largestError = [&](FieldSolver solver, const auto& magnitude) {
    FieldOptions options;
    options.solver = solver;
    options.diffuse = false;
    options.cancelDistance = 0.0;
    const CrossField field = solve(patch, options);
    double worst = 0.0;
    for (const VertexId v : patch.surface.vertices()) {
      worst = std::max(worst, std::fabs(field.magnitude[v] - magnitude(norm(patch.surface.position(v)))));
    }
    return worst;
  };
  const auto power = [](double r, int n) { return std::pow(r, n); };
  EXPECT_LT(largestError(FieldSolver::eliminate, [&](double r) { return power(r, 4); }), 0.01);
  EXPECT_LT(largestError(FieldSolver::leastSquares, [&](double r) { return 3.0 * power(r, 4) - 2.0 * power(r, 6); }),
            0.06);
}

TEST(PlanarField, PinsTheEdgesOfTheKindsAskedFor) {
  Patch patch = testing::makeSquare(8);
  const Surface& surface = patch.surface;
  std::vector<std::uint8_t> kinds(4, static_cast<std::uint8_t>(EdgeKind::boundary));
  // Below and above: edges of other kinds.
  std::array<std::int32_t, 2> horizontal{kNone, kNone};
  for (const HalfedgeId h : surface.halfedges()) {
    if (!surface.isBoundary(h)) continue;
    const Vec3 a = surface.position(surface.origin(h));
    const Vec3 b = surface.position(surface.target(h));
    if (a.y == b.y) horizontal[a.y > 0.5 ? 1 : 0] = patch.edge[h];
  }
  kinds[static_cast<std::size_t>(horizontal[0])] = static_cast<std::uint8_t>(EdgeKind::sharp);
  kinds[static_cast<std::size_t>(horizontal[1])] = static_cast<std::uint8_t>(EdgeKind::nonManifold);
  for (int choice = 0; choice < 8; ++choice) {
    FieldOptions options;
    options.boundary = (choice & 1) != 0;
    options.sharp = (choice & 2) != 0;
    options.nonManifold = (choice & 4) != 0;
    SilentProgress progress;
    const Result<CrossField> field = computeCrossField(patch, kinds, options, progress);
    ASSERT_TRUE(field.ok());
    for (const VertexId v : surface.vertices()) {
      const Vec3 p = surface.position(v);
      FieldPin expected = FieldPin::none;
      if (options.boundary && (p.x == 0.0 || p.x == 1.0)) expected = FieldPin::boundary;
      if (options.sharp && p.y == 0.0) expected = FieldPin::sharp;
      if (options.nonManifold && p.y == 1.0) expected = FieldPin::nonManifold;
      EXPECT_EQ(field.value().constrained[v], expected);
      EXPECT_TRUE(expected == FieldPin::none || field.value().magnitude[v] == 1.0);
    }
  }
}

TEST(PlanarField, LetsEdgesComeBeforeStrokesAndNearStrokesBeforeFarOnes) {
  const Patch patch = testing::makeSquare(10);
  FieldOptions options;
  options.strokes = {{{0.0, 0.48, 0.0}, {1.0, 0.48, 0.0}},  // along the nodes of y = 0.5, but ...
                     {{0.4, 0.4, 0.0}, {0.6, 0.6, 0.0}}};   // ... farther from (0.5, 0.5) than this one
  const CrossField field = solve(patch, options);
  for (const VertexId v : patch.surface.vertices()) {
    const Vec3 p = patch.surface.position(v);
    if (patch.surface.isBoundary(v)) {
      EXPECT_EQ(field.constrained[v], FieldPin::boundary);
      EXPECT_EQ(field.cross[v], std::complex<double>(1.0));
    }
    const bool middle = norm(p - Vec3{0.5, 0.5, 0.0}) < 1e-9;
    if (!middle) continue;
    EXPECT_EQ(field.constrained[v], FieldPin::user);
    const double angle = std::arg(field.cross[v]) / 4.0;
    const Vec3 d = field.frame[v].x * std::cos(angle) + field.frame[v].y * std::sin(angle);
    EXPECT_NEAR(std::fabs(d.x), std::sqrt(0.5), 1e-9);
  }
}

TEST(PlanarField, RefusesOptionsOutOfRange) {
  const Patch patch = testing::makeSquare(3);
  const auto refused = [&](auto change) {
    FieldOptions options;
    change(options);
    SilentProgress progress;
    const Result<CrossField> field = computeCrossField(patch, {}, options, progress);
    return !field.ok() && field.error().code == ErrorCode::invalidOption;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused([](FieldOptions& o) { o.energy = FieldEnergy::finiteElements, o.smoothness = 1.1; }));
  EXPECT_TRUE(refused([](FieldOptions& o) { o.smoothness = 0.5; }));
  EXPECT_TRUE(refused([](FieldOptions& o) { o.shift = 0.1; }));
  EXPECT_TRUE(refused([nan](FieldOptions& o) { o.guidance = nan; }));
  EXPECT_TRUE(refused([nan](FieldOptions& o) { o.denseBoundary = nan; }));
  EXPECT_TRUE(refused([](FieldOptions& o) { o.pinAnisotropy = 2.0; }));
  EXPECT_TRUE(refused([](FieldOptions& o) { o.pinTurn = -1.0; }));
  EXPECT_TRUE(refused([](FieldOptions& o) { o.diffusionLength = 0.0; }));
  EXPECT_TRUE(refused([](FieldOptions& o) { o.cancelDistance = -1.0; }));
  EXPECT_FALSE(refused([](FieldOptions&) {}));
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
