#include "qmcf/base/vec.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "qmcf/base/bits.hpp"
#include "qmcf/base/random.hpp"

namespace qmcf {
namespace {

Vec3 randomVector(Random& random) {
  return {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
}

TEST(Vec, CrossProductIsRightHandedAndOrthogonalToBothFactors) {
  EXPECT_EQ(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3 a = randomVector(random);
    const Vec3 b = randomVector(random);
    const Vec3 c = cross(a, b);
    EXPECT_NEAR(dot(a, c), 0.0, 1e-14);
    EXPECT_NEAR(dot(b, c), 0.0, 1e-14);
    // Lagrange's identity.
    EXPECT_NEAR(squaredNorm(c) + dot(a, b) * dot(a, b), squaredNorm(a) * squaredNorm(b), 1e-12);
  }
}

TEST(Vec, PlaneCrossProductIsTwiceTheSignedArea) {
  EXPECT_EQ(cross(Vec2{3, 0}, Vec2{1, 4}), 12.0);
  EXPECT_EQ(cross(Vec2{1, 4}, Vec2{3, 0}), -12.0);
}

TEST(Vec, NormalizedHasLengthOneAndZeroStaysZero) {
  EXPECT_NEAR(norm(normalized(Vec3{3, -4, 12})), 1.0, 1e-15);
  EXPECT_EQ(normalized(Vec3{}), Vec3{});
}

TEST(Vec, TangentPartIsOrthogonalToTheNormalAndTheRestIsAlongIt) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Vec3 v = randomVector(random);
    const Vec3 n = normalized(randomVector(random));
    const Vec3 tangent = tangentPart(v, n);
    EXPECT_NEAR(dot(tangent, n), 0.0, 1e-14);
    EXPECT_NEAR(norm(cross(v - tangent, n)), 0.0, 1e-14);
  }
}

TEST(Vec, IsFiniteLooksAtEachCoordinate) {
  EXPECT_TRUE(isFinite({1, 2, 3}));
  EXPECT_FALSE(isFinite({std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  EXPECT_FALSE(isFinite({0, std::numeric_limits<double>::infinity(), 0}));
  EXPECT_FALSE(isFinite({0, 0, -std::numeric_limits<double>::infinity()}));
}

TEST(Bits, BitCastKeepsEveryBit) {
  EXPECT_EQ(bitCast<std::uint64_t>(1.0), 0x3FF0000000000000ULL);
  EXPECT_EQ(bitCast<float>(0x40490FDBU), 3.14159274F);
}

}  // namespace
}  // namespace qmcf
