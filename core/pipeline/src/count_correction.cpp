#include "count_correction.hpp"

#include <algorithm>
#include <cmath>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

constexpr double kTolerance = 0.04;
constexpr double kFromFeatures = 1.2;
constexpr double kMostCorrection = 1.5;
constexpr double kMostElements = 1e7;

bool isNear(double ratio) { return ratio > 1.0 - kTolerance && ratio < 1.0 + kTolerance; }

}  // namespace

std::int64_t roundedCount(double count) {
  return static_cast<std::int64_t>(std::clamp(count, 1.0, kMostElements) + 0.5);
}

std::int64_t correctedCount(const CountTrial& trial, std::int64_t wanted) {
  const double ratio = trial.made / static_cast<double>(trial.asked);
  if (isNear(ratio) || ratio > kFromFeatures || !(ratio > 0.0)) return wanted;
  return roundedCount(static_cast<double>(wanted) * std::min(1.0 / ratio, kMostCorrection));
}

std::int64_t correctedCount(const CountTrial& first, const CountTrial& second, std::int64_t wanted) {
  const auto goal = static_cast<double>(wanted);
  const bool firstIsNearer = std::fabs(first.made - goal) <= std::fabs(second.made - goal);
  const CountTrial& nearer = firstIsNearer ? first : second;
  const bool isBetween = (first.made > goal) != (second.made > goal);
  if (isNear(nearer.made / goal) || !isBetween || !(std::min(first.made, second.made) > 0.0)) return nearer.asked;
  const double share = math::log(goal / first.made) / math::log(second.made / first.made);
  const auto asked = static_cast<double>(first.asked);
  return roundedCount(asked * math::exp(share * math::log(static_cast<double>(second.asked) / asked)));
}

}  // namespace qmcf
