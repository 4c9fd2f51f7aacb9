#pragma once

#include <complex>

/// Transcendental functions with the same result, to the last bit, on every platform.
/// The C libraries of browsers, Node and native systems differ there; whatever influences a mesh goes through these.
/// Only + - * / sqrt, floor, fmod (all exactly defined), comparisons and bit operations are used inside. Error below 2
/// ulp on the ranges given.
namespace qmcf::math {

inline constexpr double kPi = 3.141592653589793238462643383279502884;

/// Sine and cosine; |x| <= 1e5 (beyond that precision falls off, never NaN for finite x).
double sin(double x);
double cos(double x);
/// Angle of (x, y) in (-pi, pi]; 0 for the zero vector. Signs of zero are ignored.
double atan2(double y, double x);
/// Arc cosine; the argument is clamped to [-1, 1].
double acos(double x);
/// Exponential; 0 below -745.2, the largest double above 709.78.
double exp(double x);
/// Natural logarithm of x > 0; -infinity for 0, NaN below.
double log(double x);
/// Base-2 logarithm of x > 0; -infinity for 0, NaN below.
double log2(double x);
/// sqrt(x^2 + y^2) without overflow or underflow on the way.
double hypot(double x, double y);

/// bound tanh(x / bound): x, bent to stay within bound either way, with slope 1 at 0. \pre bound > 0
double bent(double x, double bound);

/// Angle of z in (-pi, pi].
inline double arg(std::complex<double> z) { return atan2(z.imag(), z.real()); }
/// e^(i angle).
inline std::complex<double> unitComplex(double angle) { return {cos(angle), sin(angle)}; }
/// z / |z|, or 0 when z is 0.
std::complex<double> normalized(std::complex<double> z);

}  // namespace qmcf::math
