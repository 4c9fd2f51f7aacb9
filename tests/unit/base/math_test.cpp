#include "qmcf/base/math.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "qmcf/base/random.hpp"

namespace qmcf {
namespace {

constexpr int kSamples = 100000;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Distance of a result from the true value in units of the last place of the true value as a double.
double ulpError(double value, long double truth) {
  const double rounded = std::fabs(static_cast<double>(truth));
  const double ulp = std::nextafter(rounded, kInfinity) - rounded;
  return static_cast<double>(std::fabs(static_cast<long double>(value) - truth) / static_cast<long double>(ulp));
}

/// Largest error over uniform samples of [low, high]; the truth is computed with long double.
template <class F, class Truth>
double worstError(double low, double high, F f, Truth truth) {
  Random random(7);
  double worst = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double x = random.uniform(low, high);
    worst = std::fmax(worst, ulpError(f(x), truth(static_cast<long double>(x))));
  }
  return worst;
}

constexpr auto kTrueSin = [](long double x) { return std::sin(x); };
constexpr auto kTrueCos = [](long double x) { return std::cos(x); };

TEST(Math, SinAndCosAreWithinTwoUlp) {
  for (const double range : {0.1, 0.8, 7.0, 1000.0, 1e5}) {
    EXPECT_LT(worstError(-range, range, math::sin, kTrueSin), 2.0) << range;
    EXPECT_LT(worstError(-range, range, math::cos, kTrueCos), 2.0) << range;
  }
}

TEST(Math, SinAndCosAreWithinTwoUlpNextToMultiplesOfAQuarterTurn) {
  for (int k = 1; k < 60000; ++k) {
    const double x = k * (math::kPi / 2.0);
    ASSERT_LT(ulpError(math::sin(x), std::sin(static_cast<long double>(x))), 2.0) << k;
    ASSERT_LT(ulpError(math::cos(x), std::cos(static_cast<long double>(x))), 2.0) << k;
  }
}

TEST(Math, SinAndCosOfSpecialValues) {
  EXPECT_EQ(math::sin(0.0), 0.0);
  EXPECT_EQ(math::cos(0.0), 1.0);
  EXPECT_EQ(math::sin(math::kPi / 2.0), 1.0);
  EXPECT_EQ(math::cos(math::kPi), -1.0);
  EXPECT_EQ(math::sin(1e-300), 1e-300);
  EXPECT_EQ(math::sin(-3.0), -math::sin(3.0));
  for (const double huge : {1e6, 1e22, 1e300, std::numeric_limits<double>::max()}) {
    EXPECT_LE(std::fabs(math::sin(huge)), 1.0);
    EXPECT_LE(std::fabs(math::cos(-huge)), 1.0);
  }
}

TEST(Math, SquaresOfSinAndCosSumToOne) {
  Random random(3);
  for (int i = 0; i < kSamples; ++i) {
    const std::complex<double> z = math::unitComplex(random.uniform(-1e5, 1e5));
    ASSERT_NEAR(std::norm(z), 1.0, 4e-16);
  }
}

TEST(Math, Atan2IsWithinTwoUlpInEveryQuadrant) {
  Random random(11);
  for (int i = 0; i < kSamples; ++i) {
    const double x = random.uniform(-1.0, 1.0);
    const double y = random.uniform(-1.0, 1.0) * std::exp(random.uniform(-30.0, 30.0));
    ASSERT_LT(ulpError(math::atan2(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x))), 2.0)
        << y << " " << x;
  }
}

TEST(Math, Atan2OfSpecialValues) {
  EXPECT_EQ(math::atan2(0.0, 0.0), 0.0);
  EXPECT_EQ(math::atan2(-0.0, -0.0), 0.0);
  EXPECT_EQ(math::atan2(0.0, 2.0), 0.0);
  EXPECT_EQ(math::atan2(0.0, -2.0), math::kPi);
  EXPECT_EQ(math::atan2(-0.0, -2.0), math::kPi);
  EXPECT_EQ(math::atan2(2.0, 0.0), math::kPi / 2.0);
  EXPECT_EQ(math::atan2(-2.0, 0.0), -math::kPi / 2.0);
  EXPECT_EQ(math::atan2(1.0, 1.0), math::kPi / 4.0);
  EXPECT_EQ(math::atan2(-1.0, -1.0), -0.75 * math::kPi);
  EXPECT_EQ(math::atan2(1e300, 1e-300), math::kPi / 2.0);
  EXPECT_EQ(math::atan2(1e-320, 1e300), 0.0);
}

TEST(Math, AcosIsWithinTwoUlp) {
  const auto truth = [](long double x) { return std::acos(x); };
  EXPECT_LT(worstError(-1.0, 1.0, math::acos, truth), 2.0);
  EXPECT_LT(worstError(0.999999, 1.0, math::acos, truth), 2.0);
  EXPECT_LT(worstError(-1.0, -0.999999, math::acos, truth), 2.0);
}

TEST(Math, AcosClampsItsArgument) {
  EXPECT_EQ(math::acos(1.0), 0.0);
  EXPECT_EQ(math::acos(1.0 + 1e-12), 0.0);
  EXPECT_EQ(math::acos(-1.0), math::kPi);
  EXPECT_EQ(math::acos(-7.0), math::kPi);
  EXPECT_EQ(math::acos(0.0), math::kPi / 2.0);
}

TEST(Math, ExpIsWithinTwoUlp) {
  const auto truth = [](long double x) { return std::exp(x); };
  EXPECT_LT(worstError(-1.0, 1.0, math::exp, truth), 2.0);
  EXPECT_LT(worstError(-745.0, 709.7, math::exp, truth), 2.0);
}

TEST(Math, BentStaysWithinItsBoundAndIsOddWithSlopeOne) {
  EXPECT_EQ(math::bent(0.0, 0.3), 0.0);
  EXPECT_NEAR(math::bent(1e-3, 0.3), 1e-3, 1e-8);
  EXPECT_NEAR(math::bent(0.3, 0.3), 0.3 * std::tanh(1.0), 1e-15);
  EXPECT_EQ(math::bent(-0.2, 0.3), -math::bent(0.2, 0.3));
  EXPECT_LE(math::bent(100.0, 0.3), 0.3);
  EXPECT_GE(math::bent(-HUGE_VAL, 0.3), -0.3);
}

TEST(Math, ExpOfSpecialValues) {
  EXPECT_EQ(math::exp(0.0), 1.0);
  EXPECT_EQ(math::exp(-746.0), 0.0);
  EXPECT_EQ(math::exp(-kInfinity), 0.0);
  EXPECT_EQ(math::exp(710.0), std::numeric_limits<double>::max());
  EXPECT_EQ(math::exp(kInfinity), std::numeric_limits<double>::max());
  EXPECT_TRUE(std::isnan(math::exp(std::nan(""))));
}

TEST(Math, LogarithmsAreWithinTwoUlp) {
  const auto trueLog = [](long double x) { return std::log(x); };
  const auto trueLog2 = [](long double x) { return std::log2(x); };
  for (const double high : {1e-310, 1e-5, 1.1, 3.0, 1e10, 1e308}) {
    EXPECT_LT(worstError(high / 1024.0, high, math::log, trueLog), 2.0) << high;
    EXPECT_LT(worstError(high / 1024.0, high, math::log2, trueLog2), 2.0) << high;
  }
  EXPECT_LT(worstError(0.999, 1.001, math::log, trueLog), 2.0);
  EXPECT_LT(worstError(0.999, 1.001, math::log2, trueLog2), 2.0);
}

TEST(Math, LogarithmsOfSpecialValues) {
  EXPECT_EQ(math::log(1.0), 0.0);
  for (int k = -1074; k < 1024; ++k) EXPECT_EQ(math::log2(std::ldexp(1.0, k)), k);
  EXPECT_EQ(math::log(0.0), -kInfinity);
  EXPECT_EQ(math::log2(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(math::log(-1.0)));
}

TEST(Math, HypotIsWithinTwoUlpAndNeverOverflowsOnTheWay) {
  Random random(5);
  for (int i = 0; i < kSamples; ++i) {
    const double scale = std::exp(random.uniform(-700.0, 700.0));
    const double x = random.uniform(-1.0, 1.0) * scale;
    const double y = random.uniform(-1.0, 1.0) * scale;
    ASSERT_LT(ulpError(math::hypot(x, y), std::hypot(static_cast<long double>(x), static_cast<long double>(y))), 2.0);
  }
  EXPECT_EQ(math::hypot(3e300, 4e300), 5e300);
  EXPECT_EQ(math::hypot(0.0, 0.0), 0.0);
  EXPECT_EQ(math::hypot(0.0, -5e-324), 5e-324);
}

TEST(Math, NormalizedHasLengthOneOrIsZero) {
  for (const double scale : {1e-310, 1e-200, 1e-3, 1.0, 1e200, 1e308}) {
    const std::complex<double> z = math::normalized({-0.6 * scale, 0.8 * scale});
    EXPECT_NEAR(z.real(), -0.6, 1e-12) << scale;
    EXPECT_NEAR(z.imag(), 0.8, 1e-12) << scale;
  }
  EXPECT_EQ(math::normalized({0.0, 0.0}), std::complex<double>(0.0, 0.0));
}

TEST(Math, ArgAndUnitComplexAreInverse) {
  for (double angle = -3.1; angle < 3.14; angle += 0.01) {
    EXPECT_NEAR(math::arg(math::unitComplex(angle)), angle, 1e-15);
  }
}

}  // namespace
}  // namespace qmcf
