// Polynomials, constants and argument reductions are those of fdlibm (e_acos.c, e_atan2.c, e_exp.c, e_log.c, k_cos.c,
// k_sin.c, e_rem_pio2.c, s_atan.c) and of FreeBSD's e_log2.c, whose error bounds are below 1 ulp:
//
// Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved.
// Developed at SunSoft, a Sun Microsystems, Inc. business. Permission to use, copy, modify, and distribute this
// software is freely granted, provided that this notice is preserved.

#include "qmcf/base/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "qmcf/base/bits.hpp"

namespace qmcf::math {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLargest = std::numeric_limits<double>::max();

constexpr double kHalfPiHigh = 1.57079632679489655800e+00;
constexpr double kHalfPiLow = 6.12323399573676603587e-17;
constexpr double kPiLow = 1.2246467991473531772e-16;
constexpr double kLn2High = 6.93147180369123816490e-01;
constexpr double kLn2Low = 1.90821492927058770002e-10;

/// x without the lower half of its significand, so that its square is exact.
double upperHalf(double x) { return bitCast<double>(bitCast<std::uint64_t>(x) & 0xFFFFFFFF00000000ULL); }

/// 2^k for k in [-1022, 1023].
double powerOfTwo(int k) { return bitCast<double>(static_cast<std::uint64_t>(k + 1023) << 52U); }

/// An angle in [-pi/4, pi/4] as a sum of two doubles, and the number of quarter turns that were taken away, modulo 4.
struct ReducedAngle {
  double high = 0.0;
  double low = 0.0;
  int quarter = 0;
};

ReducedAngle reduce(double x) {
  constexpr double kTwoOverPi = 6.36619772367581382433e-01;
  constexpr double kPart1 = 1.57079632673412561417e+00;  // The first 33 bits of pi/2: products with n are exact.
  constexpr double kPart1Tail = 6.07710050650619224932e-11;
  constexpr double kPart2 = 6.07710050630396597660e-11;  // The next 33 bits.
  constexpr double kPart2Tail = 2.02226624879595063154e-21;
  constexpr double kPart3 = 2.02226624871116645580e-21;
  constexpr double kPart3Tail = 8.47842766036889956997e-32;
  constexpr double kExactLimit = 524288.0;

  // fmod is exact by definition, hence the same everywhere.
  if (std::fabs(x) > kExactLimit) x = std::fmod(x, 2.0 * kPi);
  if (std::fabs(x) <= kPi / 4.0) return {x, 0.0, 0};
  const double n = std::floor(x * kTwoOverPi + 0.5);
  double rest = x - n * kPart1;
  double tail = n * kPart1Tail;
  double high = rest - tail;
  if (std::fabs(high) < 0x1p-16 * std::fabs(x)) {  // Cancellation: more bits of pi/2 are needed.
    double before = rest;
    double part = n * kPart2;
    rest = before - part;
    tail = n * kPart2Tail - ((before - rest) - part);
    high = rest - tail;
    if (std::fabs(high) < 0x1p-49 * std::fabs(x)) {
      before = rest;
      part = n * kPart3;
      rest = before - part;
      tail = n * kPart3Tail - ((before - rest) - part);
      high = rest - tail;
    }
  }
  return {high, (rest - high) - tail, static_cast<int>(n - 4.0 * std::floor(n / 4.0))};
}

double sinNearZero(double x, double low) {
  constexpr double kS1 = -1.66666666666666324348e-01;
  constexpr double kS2 = 8.33333333332248946124e-03;
  constexpr double kS3 = -1.98412698298579493134e-04;
  constexpr double kS4 = 2.75573137070700676789e-06;
  constexpr double kS5 = -2.50507602534068634195e-08;
  constexpr double kS6 = 1.58969099521155010221e-10;
  const double z = x * x;
  const double w = z * z;
  const double r = kS2 + z * (kS3 + z * kS4) + z * w * (kS5 + z * kS6);
  const double v = z * x;
  return x - ((z * (0.5 * low - v * r) - low) - v * kS1);
}

double cosNearZero(double x, double low) {
  constexpr double kC1 = 4.16666666666666019037e-02;
  constexpr double kC2 = -1.38888888888741095749e-03;
  constexpr double kC3 = 2.48015872894767294178e-05;
  constexpr double kC4 = -2.75573143513906633035e-07;
  constexpr double kC5 = 2.08757232129817482790e-09;
  constexpr double kC6 = -1.13596475577881948265e-11;
  const double z = x * x;
  const double zz = z * z;
  const double r = z * (kC1 + z * (kC2 + z * kC3)) + zz * zz * (kC4 + z * (kC5 + z * kC6));
  const double half = 0.5 * z;
  const double w = 1.0 - half;
  return w + (((1.0 - w) - half) + (z * r - x * low));
}

/// Arc tangent of x in [0, infinity].
double atanPositive(double x) {
  double high = 0.0;
  double low = 0.0;
  double t = x;
  if (x >= 39.0 / 16.0) {
    high = kHalfPiHigh;
    low = kHalfPiLow;
    t = -1.0 / x;
  } else if (x >= 19.0 / 16.0) {
    high = 9.82793723247329054082e-01;  // atan(3/2)
    low = 1.39033110312309984516e-17;
    t = (x - 1.5) / (1.0 + 1.5 * x);
  } else if (x >= 11.0 / 16.0) {
    high = 7.85398163397448278999e-01;  // atan(1)
    low = 3.06161699786838301793e-17;
    t = (x - 1.0) / (x + 1.0);
  } else if (x >= 7.0 / 16.0) {
    high = 4.63647609000806093515e-01;  // atan(1/2)
    low = 2.26987774529616870924e-17;
    t = (2.0 * x - 1.0) / (2.0 + x);
  }
  const double z = t * t;
  const double w = z * z;
  const double even = z * (3.33333333333329318027e-01 +
                           w * (1.42857142725034663711e-01 +
                                w * (9.09088713343650656196e-02 +
                                     w * (6.66107313738753120669e-02 +
                                          w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
  const double odd =
      w *
      (-1.99999999998764832476e-01 +
       w * (-1.11111104054623557880e-01 +
            w * (-7.69187620504482999495e-02 + w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
  return high - ((t * (even + odd) - low) - t);
}

/// (asin(s) - s) / s for z = s * s in [0, 1/4].
double asinSeries(double z) {
  const double p = z * (1.66666666666666657415e-01 +
                        z * (-3.25565818622400915405e-01 +
                             z * (2.01212532134862925881e-01 +
                                  z * (-4.00555345006794114027e-02 +
                                       z * (7.91534994289814532176e-04 + z * 3.47933107596021167570e-05)))));
  const double q =
      1.0 + z * (-2.40339491173441421878e+00 +
                 z * (2.02094576023350569471e+00 + z * (-6.88283971605453293030e-01 + z * 7.70381505559019352791e-02)));
  return p / q;
}

/// log(x) = exponent * log(2) + f - halfSquare + rest, with 1 + f in [sqrt(1/2), sqrt(2)].
struct LogParts {
  double exponent = 0.0;
  double f = 0.0;
  double halfSquare = 0.0;
  double rest = 0.0;
};

/// \pre 0 < x < infinity
LogParts logParts(double x) {
  constexpr std::uint64_t kSqrtHalfBits = 0x3FE6A09E667F3BCDULL;
  constexpr std::uint64_t kOneBits = 0x3FF0000000000000ULL;
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {  // Subnormal.
    x *= 0x1p54;
    exponent = -54;
  }
  const std::uint64_t shifted = bitCast<std::uint64_t>(x) + (kOneBits - kSqrtHalfBits);
  exponent += static_cast<int>(shifted >> 52U) - 1023;
  const double f = bitCast<double>((shifted & 0x000FFFFFFFFFFFFFULL) + kSqrtHalfBits) - 1.0;
  const double s = f / (2.0 + f);
  const double z = s * s;
  const double w = z * z;
  const double even = w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
  const double odd =
      z * (6.666666666666735130e-01 +
           w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
  const double halfSquare = 0.5 * f * f;
  return {static_cast<double>(exponent), f, halfSquare, s * (halfSquare + (odd + even))};
}

/// The logarithm of what has none or an infinite one; only called for x <= 0, infinity and NaN.
double logOfSpecial(double x) {
  if (x == 0.0) return -kInfinity;
  return x > 0.0 ? kInfinity : kNaN;
}

bool hasFiniteLog(double x) { return x > 0.0 && x < kInfinity; }

/// A power of two that brings a magnitude to where its square neither overflows nor loses bits.
double safeScale(double magnitude) {
  if (magnitude > 0x1p500) return 0x1p-600;
  if (magnitude < 0x1p-450) return 0x1p600;
  return 1.0;
}

}  // namespace

double sin(double x) {
  const ReducedAngle angle = reduce(x);
  const double value = angle.quarter % 2 == 0 ? sinNearZero(angle.high, angle.low) : cosNearZero(angle.high, angle.low);
  return angle.quarter < 2 ? value : -value;
}

double cos(double x) {
  const ReducedAngle angle = reduce(x);
  const double value = angle.quarter % 2 == 0 ? cosNearZero(angle.high, angle.low) : sinNearZero(angle.high, angle.low);
  return angle.quarter == 0 || angle.quarter == 3 ? value : -value;
}

double atan2(double y, double x) {
  if (y == 0.0) return x < 0.0 ? kPi : 0.0;
  if (x == 0.0) return y > 0.0 ? kHalfPiHigh : -kHalfPiHigh;
  double angle = atanPositive(std::fabs(y / x));
  if (x < 0.0) angle = kPi - (angle - kPiLow);
  return y > 0.0 ? angle : -angle;
}

double acos(double x) {
  if (x >= 1.0) return 0.0;
  if (x <= -1.0) return kPi;
  if (std::fabs(x) < 0.5) return kHalfPiHigh - (x - (kHalfPiLow - x * asinSeries(x * x)));
  const double z = 0.5 * (1.0 - std::fabs(x));
  const double s = std::sqrt(z);
  if (x < 0.0) return 2.0 * (kHalfPiHigh - (s + (asinSeries(z) * s - kHalfPiLow)));
  const double high = upperHalf(s);
  const double low = (z - high * high) / (s + high);
  return 2.0 * (high + (asinSeries(z) * s + low));
}

double exp(double x) {
  constexpr double kOverflow = 709.782712893383973096;
  constexpr double kUnderflow = -745.13321910194110842;
  constexpr double kOneOverLn2 = 1.44269504088896338700e+00;
  if (x != x) return x;
  if (x > kOverflow) return kLargest;
  if (x < kUnderflow) return 0.0;
  const double k = std::floor(x * kOneOverLn2 + 0.5);
  const double high = x - k * kLn2High;
  const double low = k * kLn2Low;
  const double r = high - low;
  const double rr = r * r;
  const double c = r - rr * (1.66666666666666019037e-01 +
                             rr * (-2.77777777770155933842e-03 +
                                   rr * (6.61375632143793436117e-05 +
                                         rr * (-1.65339022054652515390e-06 + rr * 4.13813679705723846039e-08))));
  const double value = 1.0 + (r * c / (2.0 - c) - low + high);
  // 2^k itself may be out of range where the product is not; only the second product can round.
  const int whole = static_cast<int>(k);
  const int half = whole / 2;
  return value * powerOfTwo(half) * powerOfTwo(whole - half);
}

double log(double x) {
  if (!hasFiniteLog(x)) return logOfSpecial(x);
  const LogParts p = logParts(x);
  return p.rest + p.exponent * kLn2Low - p.halfSquare + p.f + p.exponent * kLn2High;
}

double log2(double x) {
  constexpr double kOneOverLn2High = 1.44269504072144627571e+00;
  constexpr double kOneOverLn2Low = 1.67517131648865118353e-10;
  if (!hasFiniteLog(x)) return logOfSpecial(x);
  const LogParts p = logParts(x);
  const double high = upperHalf(p.f - p.halfSquare);
  const double low = (p.f - high) - p.halfSquare + p.rest;
  const double product = high * kOneOverLn2High;
  const double productLow = (low + high) * kOneOverLn2Low + low * kOneOverLn2High;
  const double sum = p.exponent + product;
  return productLow + ((p.exponent - sum) + product) + sum;
}

double hypot(double x, double y) {
  const double scale = safeScale(std::max(std::fabs(x), std::fabs(y)));
  const double a = x * scale;
  const double b = y * scale;
  return std::sqrt(a * a + b * b) / scale;
}

double bent(double x, double bound) {
  const double e = exp(-2.0 * std::fabs(x) / bound);
  return (x < 0.0 ? -bound : bound) * (1.0 - e) / (1.0 + e);
}

std::complex<double> normalized(std::complex<double> z) {
  const double scale = safeScale(std::max(std::fabs(z.real()), std::fabs(z.imag())));
  const double x = z.real() * scale;
  const double y = z.imag() * scale;
  const double length = std::sqrt(x * x + y * y);
  if (!(length > 0.0)) return {0.0, 0.0};
  return {x / length, y / length};
}

}  // namespace qmcf::math
