#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "qmcf/base/math.hpp"
#include "qmcf/base/random.hpp"
#include "qmcf/quality/quality.hpp"

namespace qmcf {
namespace {

constexpr double kRadians = math::kPi / 180.0;

QuadMetrics rhombus(double angle) {
  const Vec3 side{math::cos(angle * kRadians), math::sin(angle * kRadians), 0.0};
  return quadMetrics({}, {1, 0, 0}, Vec3{1, 0, 0} + side, side);
}

TEST(QuadMetrics, SquareIsPerfect) {
  const QuadMetrics m = quadMetrics({1, 1, 1}, {3, 1, 1}, {3, 3, 1}, {1, 3, 1});
  EXPECT_DOUBLE_EQ(m.scaledJacobian, 1.0);
  EXPECT_DOUBLE_EQ(m.jacobianRatio, 1.0);
  EXPECT_DOUBLE_EQ(m.jacobianRatioGauss, 1.0);
  EXPECT_DOUBLE_EQ(m.aspectRatio, 1.0);
  EXPECT_DOUBLE_EQ(m.edgeRatio, 1.0);
  EXPECT_DOUBLE_EQ(m.orthogonalQuality, 1.0);
  EXPECT_NEAR(m.minAngle, 90.0, 1e-12);
  EXPECT_NEAR(m.maxAngle, 90.0, 1e-12);
  EXPECT_NEAR(m.skewness, 0.0, 1e-12);
  EXPECT_NEAR(m.warpage, 0.0, 1e-12);
}

TEST(QuadMetrics, RectangleHasTheRatioOfItsSides) {
  const QuadMetrics m = quadMetrics({}, {5, 0, 0}, {5, 2, 0}, {0, 2, 0});
  EXPECT_DOUBLE_EQ(m.aspectRatio, 2.5);
  EXPECT_DOUBLE_EQ(m.edgeRatio, 2.5);
  EXPECT_DOUBLE_EQ(m.scaledJacobian, 1.0);
  EXPECT_DOUBLE_EQ(m.orthogonalQuality, 1.0);
}

TEST(QuadMetrics, RhombusFollowsItsAngle) {
  for (const double angle : {20.0, 45.0, 60.0, 85.0}) {
    const QuadMetrics m = rhombus(angle);
    const double sine = std::sin(angle * kRadians);
    EXPECT_NEAR(m.scaledJacobian, sine, 1e-12);
    EXPECT_NEAR(m.jacobianRatio, 1.0, 1e-12);
    EXPECT_NEAR(m.aspectRatio, 1.0 / sine, 1e-12);
    EXPECT_NEAR(m.orthogonalQuality, sine, 1e-12);
    EXPECT_NEAR(m.minAngle, angle, 1e-10);
    EXPECT_NEAR(m.maxAngle, 180.0 - angle, 1e-10);
    EXPECT_NEAR(m.skewness, (90.0 - angle) / 90.0, 1e-12);
  }
}

TEST(QuadMetrics, TrapezoidHasALinearJacobian) {
  // Bottom 4, top 2, height 2: the determinant falls linearly from 8 to 4.
  const QuadMetrics m = quadMetrics({}, {4, 0, 0}, {3, 2, 0}, {1, 2, 0});
  const double g = 1.0 / std::sqrt(3.0);
  EXPECT_NEAR(m.jacobianRatio, 2.0, 1e-12);
  EXPECT_NEAR(m.jacobianRatioGauss, (6.0 + 2.0 * g) / (6.0 - 2.0 * g), 1e-12);
}

TEST(QuadMetrics, ConcaveQuadIsInverted) {
  const QuadMetrics m = quadMetrics({}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0});
  EXPECT_LT(m.scaledJacobian, 0.0);
  EXPECT_TRUE(std::isinf(m.jacobianRatio));
  // The sides at the third corner are (-3, 1) and (-1, 3) turned: they enclose 90 + 2 atan(1 / 3) on the outside.
  EXPECT_NEAR(m.maxAngle, 360.0 - (90.0 + 2.0 * std::atan2(1.0, 3.0) / kRadians), 1e-10);
  EXPECT_GT(m.maxAngle, 180.0);
  EXPECT_DOUBLE_EQ(m.skewness, 1.0);
}

TEST(QuadMetrics, FoldOfARightAngleWarpsByNinetyDegrees) {
  const QuadMetrics m = quadMetrics({}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1});
  EXPECT_NEAR(m.warpage, 90.0, 1e-10);
}

TEST(QuadMetrics, QuadWithoutAreaHasTheWorstValues) {
  const QuadMetrics point = quadMetrics({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1});
  const QuadMetrics line = quadMetrics({}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0});
  for (const QuadMetrics& m : {point, line}) {
    EXPECT_EQ(m.scaledJacobian, 0.0);
    EXPECT_TRUE(std::isinf(m.jacobianRatio));
    EXPECT_TRUE(std::isinf(m.aspectRatio));
    EXPECT_EQ(m.orthogonalQuality, 0.0);
  }
}

TEST(QuadMetrics, DoNotDependOnPlaceSizeOrFirstCorner) {
  Random random(7);
  const Vec3 x = normalized(Vec3{1, 2, 3});
  const Vec3 y = normalized(cross(x, Vec3{1, 0, 0}));
  const Vec3 z = cross(x, y);
  for (int round = 0; round < 200; ++round) {
    std::array<Vec3, 4> p{Vec3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (Vec3& q : p) q += Vec3{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)};
    const QuadMetrics m = quadMetrics(p[0], p[1], p[2], p[3]);
    std::array<Vec3, 4> moved;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& q = p[(i + 1) % 4];
      moved[i] = Vec3{5, -3, 2} + (x * q.x + y * q.y + z * q.z) * 1e-3;
    }
    const QuadMetrics n = quadMetrics(moved[0], moved[1], moved[2], moved[3]);
    EXPECT_NEAR(m.scaledJacobian, n.scaledJacobian, 1e-9);
    EXPECT_NEAR(m.jacobianRatioGauss / n.jacobianRatioGauss, 1.0, 1e-8);
    EXPECT_NEAR(m.aspectRatio / n.aspectRatio, 1.0, 1e-9);
    EXPECT_NEAR(m.orthogonalQuality, n.orthogonalQuality, 1e-9);
    EXPECT_NEAR(m.minAngle, n.minAngle, 1e-6);
    EXPECT_NEAR(m.maxAngle, n.maxAngle, 1e-6);
    EXPECT_NEAR(m.warpage, n.warpage, 1e-6);
    EXPECT_EQ(m.scaledJacobian, quadScaledJacobian(p[0], p[1], p[2], p[3]));
  }
}

TEST(TriangleScaledJacobian, KnowsTheEquilateralAndTheRightTriangle) {
  EXPECT_NEAR(triangleScaledJacobian({}, {2, 0, 0}, {1, std::sqrt(3.0), 0}), 1.0, 1e-12);
  EXPECT_NEAR(triangleScaledJacobian({}, {1, 0, 0}, {0, 1, 0}), std::sqrt(2.0 / 3.0), 1e-12);
  EXPECT_EQ(triangleScaledJacobian({}, {1, 0, 0}, {3, 0, 0}), 0.0);
  EXPECT_EQ(triangleScaledJacobian({1, 1, 1}, {1, 1, 1}, {1, 1, 1}), 0.0);
}

}  // namespace
}  // namespace qmcf
