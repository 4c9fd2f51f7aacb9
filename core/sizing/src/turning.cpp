// Simplification: Douglas and Peucker 1973.
#include "turning.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

double squaredDistanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length = squaredNorm(along);
  const double t = length > 0.0 ? std::clamp(dot(p - a, along) / length, 0.0, 1.0) : 0.0;
  return squaredNorm(a + along * t - p);
}

/// Indices of the points that remain; the first and the last always do.
std::vector<std::size_t> simplified(const EdgeCurve& curve, double tolerance) {
  std::vector<bool> keep(curve.points.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, curve.points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double farthest = tolerance * tolerance;
    std::size_t split = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double d = squaredDistanceToSegment(curve.points[i], curve.points[first], curve.points[last]);
      if (d > farthest) {
        farthest = d;
        split = i;
      }
    }
    if (split == first) continue;
    keep[split] = true;
    open.emplace_back(first, split);
    open.emplace_back(split, last);
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i]) kept.push_back(i);
  }
  return kept;
}

double turnBetween(const Vec3& a, const Vec3& b) { return math::atan2(norm(cross(a, b)), dot(a, b)); }

/// A stretch of a curve over which a turn is spread.
struct Stretch {
  double first;
  double last;
  double angle;
};

/// How far the turn between sides of these lengths reaches into the first of them.
double reach(double side, double other) { return 0.5 * (side > 3.0 * other ? other : side); }

std::vector<Stretch> stretchesOf(const EdgeCurve& curve, const std::vector<std::size_t>& kept) {
  std::vector<Stretch> stretches;
  const std::size_t sides = kept.size() - 1;
  const auto side = [&](std::size_t k) { return curve.points[kept[k + 1]] - curve.points[kept[k]]; };
  const auto arc = [&](std::size_t k) { return curve.arcLength[kept[k]]; };
  const auto arcOfSide = [&](std::size_t k) { return arc(k + 1) - arc(k); };
  for (std::size_t k = 1; k < sides; ++k) {
    const double before = reach(arcOfSide(k - 1), arcOfSide(k));
    const double after = reach(arcOfSide(k), arcOfSide(k - 1));
    stretches.push_back({arc(k) - before, arc(k) + after, turnBetween(side(k - 1), side(k))});
  }
  if (stretches.empty()) return stretches;
  if (curve.closed) {
    const double before = reach(arcOfSide(sides - 1), arcOfSide(0));
    const double after = reach(arcOfSide(0), arcOfSide(sides - 1));
    const double turn = turnBetween(side(sides - 1), side(0));
    const double split = before + after > 0.0 ? after / (before + after) : 0.5;
    stretches.insert(stretches.begin(), Stretch{0.0, after, turn * split});
    stretches.push_back({curve.length() - before, curve.length(), turn * (1.0 - split)});
    return stretches;
  }
  // An arc turns up to its very ends, where its polygon has no corner to show for it: go on as in the nearest stretch.
  const auto extend = [](const Stretch& nearest, double end, double gap, double sideLength) -> Stretch {
    const double width = nearest.last - nearest.first;
    const bool sameArc = width > 0.0 && gap <= 0.5 * sideLength * (1.0 + 1e-9);
    const double angle = sameArc ? nearest.angle * gap / width : 0.0;
    return end < nearest.first ? Stretch{end, end + gap, angle} : Stretch{end - gap, end, angle};
  };
  const Stretch first = extend(stretches.front(), 0.0, stretches.front().first, arcOfSide(0));
  const Stretch last =
      extend(stretches.back(), curve.length(), curve.length() - stretches.back().last, arcOfSide(sides - 1));
  stretches.insert(stretches.begin(), first);
  stretches.push_back(last);
  return stretches;
}

}  // namespace

double Turning::within(double s, double width) const {
  const double length = arcLength.back();
  if (width >= length) return total();
  const auto upTo = [&](double at) {
    if (!closed) return interpolate(arcLength, angle, at);
    if (at < 0.0) return interpolate(arcLength, angle, at + length) - total();
    if (at > length) return interpolate(arcLength, angle, at - length) + total();
    return interpolate(arcLength, angle, at);
  };
  return upTo(s + 0.5 * width) - upTo(s - 0.5 * width);
}

Turning turningOf(const EdgeCurve& curve, double tolerance) {
  Turning turning;
  turning.closed = curve.closed;
  turning.arcLength = {0.0};
  turning.angle = {0.0};
  double sum = 0.0;
  for (const Stretch& stretch : stretchesOf(curve, simplified(curve, tolerance))) {
    turning.arcLength.push_back(std::max(stretch.first, turning.arcLength.back()));
    turning.angle.push_back(sum);
    sum += stretch.angle;
    turning.arcLength.push_back(std::max(stretch.last, turning.arcLength.back()));
    turning.angle.push_back(sum);
  }
  turning.arcLength.push_back(curve.length());
  turning.angle.push_back(sum);
  return turning;
}

}  // namespace qmcf
