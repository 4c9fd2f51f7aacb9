#include "edge_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "qmcf/base/math.hpp"
#include "turning.hpp"

namespace qmcf {
namespace {

/// The largest size in [lowest, highest] around s within which the curve turns by maxTurn at most, and as an arc of so
/// much turn is mostSagitta from its chord at most.
double sizeByTurning(const Turning& turning, double s, double maxTurn, double mostSagitta, double lowest,
                     double highest) {
  constexpr int kBisections = 24;
  constexpr double kRoundOff = 1e-9;
  const auto fits = [&](double width) {
    const double turn = turning.within(s, width);
    return turn <= maxTurn + kRoundOff && width * turn <= 8.0 * mostSagitta;
  };
  if (fits(highest)) return highest;
  double low = 0.0;
  double high = highest;
  for (int i = 0; i < kBisections && high > lowest; ++i) {
    const double middle = 0.5 * (low + high);
    (fits(middle) ? low : high) = middle;
  }
  return std::max(low, lowest);
}

/// Samples from one place of `bound` up to the next, at equal parts of the number of elements between them.
void appendSamples(EdgeSizes& sizes, const EdgeSizes& bound, std::size_t i, double spacing) {
  constexpr double kNearlyEqual = 1e-3;
  const double length = bound.arcLength[i + 1] - bound.arcLength[i];
  const double from = bound.value[i];
  const double to = bound.value[i + 1];
  const double growth = math::log(to / from);
  const bool isLevel = std::fabs(growth) < kNearlyEqual;
  const double mean = isLevel ? 0.5 * (from + to) : (to - from) / growth;
  const double pieces = std::max(1.0, std::ceil(length / (spacing * mean)));
  for (double piece = 0.0; piece < pieces; piece += 1.0) {
    const double share = piece / pieces;
    // The size is linear along the edge, so that it grows by the same factor from sample to sample.
    const double place = isLevel ? share : (math::exp(growth * share) - 1.0) / (math::exp(growth) - 1.0);
    sizes.arcLength.push_back(bound.arcLength[i] + length * place);
    sizes.value.push_back(from + (to - from) * place);
  }
}

}  // namespace

void resample(EdgeSamples& samples, double base, double spacing) {
  samples.base = base;
  samples.sizes.clear();
  for (const EdgeCurve& curve : samples.curves) {
    EdgeSizes sizes;
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
      const double from = curve.arcLength[i];
      const double length = curve.arcLength[i + 1] - from;
      const double pieces = std::max(1.0, std::ceil(length / spacing));
      for (double piece = 0.0; piece < pieces; piece += 1.0) {
        sizes.arcLength.push_back(from + length * (piece / pieces));
      }
    }
    sizes.arcLength.push_back(curve.length());
    sizes.value.assign(sizes.arcLength.size(), base);
    samples.sizes.push_back(std::move(sizes));
  }
}

void resampleUnder(EdgeSamples& samples, double base, double spacing, const std::vector<EdgeSizes>& bounds) {
  samples.base = base;
  samples.sizes.clear();
  samples.highest.clear();
  for (const EdgeSizes& bound : bounds) {
    EdgeSizes sizes;
    for (std::size_t i = 0; i + 1 < bound.value.size(); ++i) appendSamples(sizes, bound, i, spacing);
    sizes.arcLength.push_back(bound.arcLength.back());
    sizes.value.push_back(bound.value.back());
    samples.highest.push_back(sizes.value);
    samples.sizes.push_back(std::move(sizes));
  }
}

std::vector<std::int32_t> limitByTurning(EdgeSamples& samples, std::int32_t divisionsPerTurn, double lowest,
                                         double mostSagitta) {
  // Wiggles below these are noise: of the element size, and of a small edge's own length.
  constexpr double kOfSize = 0.02;
  constexpr double kOfLength = 0.005;
  constexpr double kNearlyFullTurn = 0.75;
  const double fullTurn = 2.0 * math::kPi;
  std::vector<std::int32_t> minimum(samples.curves.size(), 1);
  for (std::size_t e = 0; e < samples.curves.size(); ++e) {
    const EdgeCurve& curve = samples.curves[e];
    if (curve.points.size() < 3) continue;
    const Turning turning =
        turningOf(curve, std::min({kOfSize * samples.base, kOfLength * curve.length(), mostSagitta}));
    if (curve.closed) minimum[e] = turning.total() >= kNearlyFullTurn * fullTurn ? divisionsPerTurn : 3;
    EdgeSizes& sizes = samples.sizes[e];
    for (std::size_t i = 0; i < sizes.value.size(); ++i) {
      const double size =
          sizeByTurning(turning, sizes.arcLength[i], fullTurn / divisionsPerTurn, mostSagitta, lowest, samples.base);
      sizes.value[i] = std::min(sizes.value[i], size);
    }
  }
  return minimum;
}

void limitByLength(EdgeSamples& samples, double lowest) {
  for (std::size_t e = 0; e < samples.curves.size(); ++e) {
    const double size = std::max(samples.curves[e].length(), lowest);
    for (double& value : samples.sizes[e].value) value = std::min(value, size);
  }
}

void levelAcross(EdgeSamples& samples, const std::vector<Gap>& gaps, double oneRow) {
  struct Sum {
    double logs = 0.0;
    int count = 0;
  };
  std::vector<std::vector<Sum>> sums;
  for (const EdgeSizes& sizes : samples.sizes) sums.emplace_back(sizes.value.size());
  for (const Gap& gap : gaps) {
    std::array<double, 2> size{};
    for (std::size_t end = 0; end < 2; ++end) {
      const EdgeSizes& on = samples.sizes[static_cast<std::size_t>(gap.edge[end])];
      size[end] = interpolate(on.arcLength, on.value, gap.arcLength[end]);
    }
    if (gap.distance > oneRow * std::min(size[0], size[1])) continue;
    const double change = 0.5 * math::log(size[1] / size[0]);
    for (std::size_t end = 0; end < 2; ++end) {
      const auto e = static_cast<std::size_t>(gap.edge[end]);
      const std::size_t after = samples.sizes[e].sampleAfter(gap.arcLength[end]);
      for (const std::size_t i : {after - 1, after}) {
        sums[e][i].logs += end == 0 ? change : -change;
        ++sums[e][i].count;
      }
    }
  }
  for (std::size_t e = 0; e < sums.size(); ++e) {
    for (std::size_t i = 0; i < sums[e].size(); ++i) {
      if (sums[e][i].count > 0) samples.sizes[e].value[i] *= math::exp(sums[e][i].logs / sums[e][i].count);
    }
  }
}

}  // namespace qmcf
