#include "qmcf/mesh/shape_operator.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

Surface triangleOf(const Vec3& a, const Vec3& b, const Vec3& c) {
  auto surface = Surface::build({a, b, c}, {{0, 1, 2}});
  EXPECT_TRUE(surface.ok());
  return std::move(surface).value();
}

double largest(const ShapeOperator& shape) { return std::abs(shape.deviator) + std::fabs(shape.mean); }

TEST(ShapeOperator, IsThatOfTheSphereItsCornersAndNormalsAreFrom) {
  constexpr double kRadius = 3.0;
  const Vec3 a = normalized(Vec3{1.0, 0.1, 0.0});
  const Vec3 b = normalized(Vec3{1.0, 0.0, 0.1});
  const Vec3 c = normalized(Vec3{1.0, -0.1, -0.1});
  const Surface surface = triangleOf(a * kRadius, b * kRadius, c * kRadius);
  IdMap<VertexId, Vec3> normal;
  for (const Vec3& n : {a, b, c}) normal.push_back(n);
  const ShapeOperator shape = triangleShape(surface, normal, TriangleId(0));
  EXPECT_NEAR(shape.mean, 1.0 / kRadius, 1e-9);
  EXPECT_NEAR(std::abs(shape.deviator), 0.0, 1e-9);
}

TEST(ShapeOperator, TellsTheDirectionInWhichACylinderCurves) {
  // The first edge runs along the axis, so the larger curvature is a quarter turn away: half a turn when doubled.
  const auto at = [](double angle, double z) { return Vec3{math::cos(angle), math::sin(angle), z}; };
  const auto flat = [](const Vec3& p) { return Vec3{p.x, p.y, 0.0}; };
  const Vec3 a = at(0.0, 0.2);
  const Vec3 b = at(0.0, 0.0);
  const Vec3 c = at(0.1, 0.1);
  IdMap<VertexId, Vec3> normal;
  for (const Vec3& p : {a, b, c}) normal.push_back(flat(p));
  const ShapeOperator shape = triangleShape(triangleOf(a, b, c), normal, TriangleId(0));
  EXPECT_NEAR(largest(shape), 1.0, 2e-3);
  EXPECT_NEAR(shape.deviator.real(), -0.5, 1e-3);
  EXPECT_NEAR(shape.deviator.imag(), 0.0, 1e-9);
}

TEST(ShapeOperator, IsZeroWithoutArea) {
  const Surface surface = triangleOf({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0});
  IdMap<VertexId, Vec3> normal(3, Vec3{0.0, 0.0, 1.0});
  EXPECT_EQ(largest(triangleShape(surface, normal, TriangleId(0))), 0.0);
}

TEST(AngleWeightedNormals, DoNotDependOnHowAFacetIsCut) {
  // A ridge of two facets at right angles, one of them in two triangles at the shared vertex 0, one in one.
  const auto surface =
      Surface::build({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, -1}}, {{0, 2, 3}, {0, 3, 1}, {0, 1, 4}});
  ASSERT_TRUE(surface.ok());
  const Vec3 normal = angleWeightedNormals(surface.value())[VertexId(0)];
  EXPECT_NEAR(distance(normal, normalized(Vec3{-1.0, 0.0, 1.0})), 0.0, 1e-12);
}

}  // namespace
}  // namespace qmcf
