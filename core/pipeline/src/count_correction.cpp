#include "count_correction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

constexpr double kMostCorrection = 1.5;
constexpr double kMostElements = 1e7;
constexpr double kLeastExponent = 0.5;
constexpr double kLargestExponent = 2.0;

}  // namespace

double CountCorrection::miss(double made) const {
  return made > 0.0 ? std::fabs(math::log(made / wanted_)) : std::numeric_limits<double>::infinity();
}

std::int64_t CountCorrection::next(double made, std::int64_t wanted) {
  if (made > 0.0) {
    const double x = math::log(asked_);
    const double y = math::log(made / wanted_);
    if (tried_ && x != x_) exponent_ = std::clamp((y_ - y) / (x_ - x), kLeastExponent, kLargestExponent);
    tried_ = true;
    x_ = x;
    y_ = y;
    asked_ = std::clamp(math::exp(x - y / exponent_), wanted_ / kMostCorrection, wanted_ * kMostCorrection);
  }
  const double scaled = asked_ * (static_cast<double>(wanted) / wanted_);
  return static_cast<std::int64_t>(std::clamp(scaled, 1.0, kMostElements) + 0.5);
}

}  // namespace qmcf
