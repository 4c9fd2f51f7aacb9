#include "qmcf/base/random.hpp"

#include <gtest/gtest.h>

namespace qmcf {
namespace {

TEST(Random, IsSplitmix64) {
  // First outputs for seed 1234567 of the reference implementation (Steele, Lea and Flood; Vigna's splitmix64.c).
  Random random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317ULL);
  EXPECT_EQ(random.next(), 3203168211198807973ULL);
  EXPECT_EQ(random.next(), 9817491932198370423ULL);
}

TEST(Random, UniformStaysInItsRangeAndFillsIt) {
  Random random(42);
  constexpr int kCount = 100000;
  double sum = 0.0;
  double low = 1.0;
  double high = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.uniform();
    ASSERT_GE(x, 0.0);
    ASSERT_LT(x, 1.0);
    sum += x;
    low = x < low ? x : low;
    high = x > high ? x : high;
  }
  EXPECT_NEAR(sum / kCount, 0.5, 0.005);
  EXPECT_LT(low, 0.001);
  EXPECT_GT(high, 0.999);
}

TEST(Random, UniformOfARangeScales) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.uniform(-3.0, 5.0);
    ASSERT_GE(x, -3.0);
    ASSERT_LT(x, 5.0);
  }
}

}  // namespace
}  // namespace qmcf
