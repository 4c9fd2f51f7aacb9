#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "field/patches.hpp"
#include "field/solve.hpp"
#include "qmcf/base/random.hpp"
#include "qmcf/field/cross_field.hpp"

namespace qmcf {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

CrossField solve(const Patch& patch, const FieldOptions& options = {}) {
  CrossField field = testing::solve(patch, options);
  EXPECT_EQ(gaussBonnetDefect(patch, field), 0);
  return field;
}

/// Angle in degrees between the field and the direction given, at the centre of a triangle.
double deviation(const Patch& patch, const CrossField& field, TriangleId t, const Vec3& direction) {
  const SurfacePoint centre{t, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}};
  const Vec3 d = normalized(tangentPart(direction, normalized(patch.surface.areaVector(t))));
  double best = 180.0;
  for (const Vec3& branch : crossDirections(patch.surface, field, centre)) {
    best = std::min(best, std::atan2(norm(cross(branch, d)), dot(branch, d)) / kDegree);
  }
  return best;
}

double largestDeviation(const Patch& patch, const CrossField& field, const std::function<Vec3(const Vec3&)>& axis) {
  double worst = 0.0;
  for (const TriangleId t : patch.surface.triangles()) {
    const Vec3 centre = positionOf(patch.surface, {t, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}});
    worst = std::max(worst, deviation(patch, field, t, axis(centre)));
  }
  return worst;
}

TEST(CurvedField, FollowsCylinderAndConeByCurvatureAlone) {
  FieldOptions options;
  options.boundary = false;
  for (const bool pins : {false, true}) {
    options.pinCurvature = pins;
    // Triangulated along helices, so that no edge of the interior shows the way.
    const Patch tube = testing::makeCylinder(36, 20, 3.0, 1.3);
    const CrossField alongTube = solve(tube, options);
    EXPECT_LT(largestDeviation(tube, alongTube, [](const Vec3&) { return Vec3{0.0, 0.0, 1.0}; }), 0.2);
    EXPECT_TRUE(alongTube.singularities.empty());
    if (pins) {
      const auto& constrained = alongTube.constrained.raw();
      EXPECT_GT(std::count(constrained.begin(), constrained.end(), FieldPin::curvature), 600);
    }

    const Patch cone = testing::makeCone(40, 24, 2.5, 0.4);
    const CrossField alongCone = solve(cone, options);
    const auto slant = [](const Vec3& p) {
      return normalized(Vec3{p.x, p.y, 0.0}) * (-0.6 / 2.5) + Vec3{0.0, 0.0, 1.0};
    };
    EXPECT_LT(largestDeviation(cone, alongCone, slant), 0.2);
    EXPECT_TRUE(alongCone.singularities.empty());
  }
}

TEST(CurvedField, OfTorusFollowsItsCirclesWithoutSingularity) {
  const Patch patch = testing::makeTorus(60, 24, 0.4);
  const CrossField field = solve(patch);
  EXPECT_TRUE(field.singularities.empty());
  EXPECT_LT(largestDeviation(patch, field, [](const Vec3& p) { return Vec3{-p.y, p.x, 0.0}; }), 1.0);
}

TEST(CurvedField, FollowsTheStrokesGiven) {
  const Patch patch = testing::makeSphere(12);
  FieldOptions options;
  options.strokes = {{{0.99, -0.02, -0.02}, {0.99, 0.02, 0.02}}};
  const CrossField field = solve(patch, options);
  const auto& constrained = field.constrained.raw();
  ASSERT_GE(std::count(constrained.begin(), constrained.end(), FieldPin::user), 1);
  double worst = 0.0;
  for (const TriangleId t : patch.surface.triangles()) {
    if (positionOf(patch.surface, {t, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}}).x < 0.995) continue;
    worst = std::max(worst, deviation(patch, field, t, {0.0, 1.0, 1.0}));
  }
  EXPECT_LT(worst, 3.0);
}

TEST(CurvedField, FollowsCylinderByLeastSquaresToo) {
  FieldOptions options;
  options.boundary = false;
  options.solver = FieldSolver::leastSquares;
  options.diffuse = false;
  const Patch tube = testing::makeCylinder(36, 20, 3.0, 1.3);
  for (const double shift : {0.0, -10.0, -1e6}) {  // From all smoothness to all curvature.
    options.shift = shift;
    const CrossField field = solve(tube, options);
    EXPECT_LT(largestDeviation(tube, field, [](const Vec3&) { return Vec3{0.0, 0.0, 1.0}; }), 1.0) << shift;
  }
}

// The paper's Figure 5: curvature that pulls at constrained vertices and their neighbours costs smoothness.
TEST(CurvedField, IsSmootherWhereCurvatureLeavesTheBoundaryAlone) {
  // A square bent around its diagonal, so that principal directions and boundary contradict each other everywhere.
  const auto map = [](double x, double y) { return Vec3{x, y, 0.0}; };
  Patch patch = testing::makeGrid({.nx = 16, .ny = 16, .map = map, .keep = {}}, 1.0 / 16);
  for (const VertexId v : patch.surface.vertices()) {
    const Vec3 p = patch.surface.position(v);
    const double bend = p.x + p.y - 1.0;
    const Vec3 across{std::sqrt(0.5), std::sqrt(0.5), 0.0};
    patch.normal[v] = across * std::sin(bend) + Vec3{0.0, 0.0, std::cos(bend)};
  }
  FieldOptions options;
  options.solver = FieldSolver::leastSquares;
  options.diffuse = false;
  options.cancelDistance = 0.0;
  const double masked = solve(patch, options).energy;
  options.mask = false;
  EXPECT_LT(1.02 * masked, solve(patch, options).energy);
}

// The paper's Figure 6: directions pinned where there are none to find, on a sphere, clutter the field.
TEST(CurvedField, IsTidiedByTakingBackInconsistentPins) {
  const Patch patch = testing::makeSphere(14);
  FieldOptions options;
  options.pinCurvature = true;
  options.pinAnisotropy = 0.0;
  options.pinTurn = 0.0;
  options.removeInconsistent = false;
  const CrossField cluttered = solve(patch, options);
  options.removeInconsistent = true;
  const CrossField tidy = solve(patch, options);
  EXPECT_GT(cluttered.singularities.size(), 40U);
  EXPECT_LT(tidy.singularities.size(), cluttered.singularities.size() / 2);
  EXPECT_LT(tidy.energy, 0.5 * cluttered.energy);
  // No singularity touches what is still pinned.
  EXPECT_GT(std::count(tidy.constrained.raw().begin(), tidy.constrained.raw().end(), FieldPin::curvature), 0);
  for (const Singularity& s : tidy.singularities) {
    for (const VertexId v : patch.surface.corners(s.point.triangle)) EXPECT_EQ(tidy.constrained[v], FieldPin::none);
  }
}

TEST(CurvedField, TakesBackCurvaturePinsThatContradictEachOther) {
  // Normals of a cylinder around z in one half and around x in the other: 45 degrees to each other in the plane.
  const auto map = [](double x, double y) { return Vec3{x, y, 0.0}; };
  Patch patch = testing::makeGrid({.nx = 20, .ny = 20, .map = map, .keep = {}}, 0.05);
  for (const VertexId v : patch.surface.vertices()) {
    const Vec3 p = patch.surface.position(v);
    const double bend = p.x < 0.5 ? p.x - 0.5 : (p.x - 0.5 + p.y - 0.5) * std::sqrt(0.5);
    const Vec3 across = p.x < 0.5 ? Vec3{1.0, 0.0, 0.0} : Vec3{std::sqrt(0.5), std::sqrt(0.5), 0.0};
    patch.normal[v] = across * std::sin(2.0 * bend) + Vec3{0.0, 0.0, std::cos(2.0 * bend)};
  }
  FieldOptions options;
  options.boundary = false;
  options.pinCurvature = true;
  const CrossField field = solve(patch, options);
  int removed = 0;
  for (const VertexId v : patch.surface.vertices()) {
    if (field.removed[v] == 0) continue;
    ++removed;
    EXPECT_EQ(field.constrained[v], FieldPin::none);
    EXPECT_NEAR(patch.surface.position(v).x, 0.5, 0.25);
  }
  EXPECT_GT(removed, 0);
  EXPECT_TRUE(field.singularities.empty());
}

/// The field's directions at a triangle's centre, in space, compared with those of another patch's.
double largestDifference(const Patch& a, const CrossField& fieldA, const Patch& b, const CrossField& fieldB,
                         const std::vector<std::int32_t>& triangleOfB, const std::function<Vec3(const Vec3&)>& move) {
  double worst = 0.0;
  for (const TriangleId t : a.surface.triangles()) {
    const SurfacePoint centre{t, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}};
    if (crossConfidence(fieldA, centre) < 0.2) continue;
    const TriangleId other(triangleOfB[t.index()]);
    worst = std::max(worst, deviation(b, fieldB, other, move(crossDirections(a.surface, fieldA, centre)[0])));
  }
  return worst * kDegree;
}

TEST(CurvedField, TurnsWithThePart) {
  const Patch patch = testing::makePolygonRing(5, 9, 7, true);
  const CrossField field = solve(patch);
  std::vector<std::int32_t> same(patch.surface.triangleCount());
  std::iota(same.begin(), same.end(), 0);
  for (const double angle : {0.3, 1.0, 2.5}) {
    const auto turn = [angle](const Vec3& p) {
      const Vec3 q{p.x, 0.6 * p.y - 0.8 * p.z, 0.8 * p.y + 0.6 * p.z};
      return Vec3{std::cos(angle) * q.x - std::sin(angle) * q.y, std::sin(angle) * q.x + std::cos(angle) * q.y, q.z};
    };
    const Patch turned = testing::transformed(patch, turn);
    EXPECT_LT(largestDifference(patch, field, turned, solve(turned), same, turn), 1e-6);
  }
}

struct Shuffled {
  Patch patch;
  std::vector<std::int32_t> vertex;    ///< Of the shuffled patch, per vertex of the original.
  std::vector<std::int32_t> triangle;  ///< The same of triangles.
};

/// The same patch with its vertices and triangles in another order, and each triangle from another corner on: so the
/// fans, and with them the tangent bases, begin elsewhere.
Shuffled shuffled(const Patch& patch) {
  const Surface& surface = patch.surface;
  Random random(7);
  Shuffled result;
  result.vertex.resize(surface.vertexCount());
  result.triangle.resize(surface.triangleCount());
  for (auto* order : {&result.vertex, &result.triangle}) {
    std::iota(order->begin(), order->end(), 0);
    for (std::size_t i = order->size(); i > 1; --i) std::swap((*order)[i - 1], (*order)[random.next() % i]);
  }
  std::vector<Vec3> positions(surface.vertexCount());
  testing::Corners triangles(surface.triangleCount());
  for (const VertexId v : surface.vertices()) {
    positions[static_cast<std::size_t>(result.vertex[v.index()])] = surface.position(v);
  }
  for (const TriangleId t : surface.triangles()) {
    auto& corners = triangles[static_cast<std::size_t>(result.triangle[t.index()])];
    const std::size_t first = random.next() % 3;
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] = result.vertex[surface.corners(t)[(first + c) % 3].index()];
    }
  }
  result.patch = testing::makePatch(positions, triangles, patch.size[VertexId(0)]);
  for (const VertexId v : surface.vertices()) {
    result.patch.normal[VertexId(result.vertex[v.index()])] = patch.normal[v];
  }
  return result;
}

TEST(CurvedField, DoesNotDependOnTheOrderOfVerticesAndTriangles) {
  const auto stay = [](const Vec3& p) { return p; };
  for (const Patch& patch : {testing::makeCylinder(24, 12, 2.0, 0.7), testing::makePolygonRing(5, 9, 7, true)}) {
    const Shuffled other = shuffled(patch);
    EXPECT_LT(largestDifference(patch, solve(patch), other.patch, solve(other.patch), other.triangle, stay), 1e-6);
  }
}

// Large patches begin with clusters, which depend on the order; the last time step leaves little of that.
TEST(CurvedField, OfLargePatchHardlyDependsOnTheOrder) {
  const Patch patch = testing::makePolygonRing(5, 40, 30, true);
  const CrossField field = solve(patch);
  const Shuffled other = shuffled(patch);
  const CrossField again = solve(other.patch);
  ASSERT_EQ(field.singularities.size(), again.singularities.size());
  for (const Singularity& s : field.singularities) {
    double nearest = 1e300;
    for (const Singularity& o : again.singularities) {
      nearest =
          std::min(nearest, distance(positionOf(patch.surface, s.point), positionOf(other.patch.surface, o.point)));
    }
    EXPECT_LT(nearest, 0.5 * patch.size[VertexId(0)]);
  }
}

}  // namespace
}  // namespace qmcf
