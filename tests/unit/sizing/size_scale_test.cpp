#include "qmcf/sizing/size_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace qmcf {
namespace {

/// A square of the given side in the plane z = 0, with factors at its corners.
SizeScale::Face square(double side, double left, double right) {
  return {{{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}}, {{0, 1, 2}, {0, 2, 3}}, {left, right, right, left}};
}

TEST(SizeScale, OfNothingIsOneEverywhere) {
  const SizeScale scale;
  EXPECT_TRUE(scale.empty());
  EXPECT_EQ(scale.mean(), 1.0);
}

TEST(SizeScale, IsLinearInTheTrianglesOfEachFace) {
  const SizeScale scale({square(2.0, 0.5, 1.0), square(2.0, 0.8, 0.8)});
  EXPECT_FALSE(scale.empty());
  EXPECT_NEAR(scale.at(0, {0.0, 1.0, 0.0}), 0.5, 1e-12);
  EXPECT_NEAR(scale.at(0, {1.0, 0.3, 0.0}), 0.75, 1e-12);
  EXPECT_NEAR(scale.at(0, {5.0, 1.0, 3.0}), 1.0, 1e-12);  // By the closest point.
  EXPECT_NEAR(scale.at(1, {1.0, 0.3, 0.0}), 0.8, 1e-12);
}

TEST(SizeScale, MeanMakesAsManyElements) {
  EXPECT_NEAR(SizeScale({square(3.0, 0.6, 0.6)}).mean(), 0.6, 1e-12);
  // The integral of 1 / (1/2 + x/2)^2 from 0 to 1 is 2.
  EXPECT_NEAR(SizeScale({square(1.0, 0.5, 1.0)}).mean(), std::sqrt(0.5), 1e-12);
}

}  // namespace
}  // namespace qmcf
