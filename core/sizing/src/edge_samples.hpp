#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "qmcf/sizing/edge_curve.hpp"
#include "qmcf/sizing/size_field.hpp"

namespace qmcf {

/// The edges of a B-rep with their sizes under construction.
struct EdgeSamples {
  std::vector<EdgeCurve> curves;  ///< Per edge.
  std::vector<EdgeSizes> sizes;   ///< Per edge.
  /// Per edge, per sample: the size before anything lowered it. Empty: the base size everywhere.
  std::vector<std::vector<double>> highest;
  double base = 0.0;
};

/// Two points on edges that lie opposite each other across a face.
struct Gap {
  std::array<std::int32_t, 2> edge{kNone, kNone};
  std::array<double, 2> arcLength{};
  double distance = 0.0;
};

/// Puts samples at each point of every edge and, between points, at most `spacing` apart, all with the size `base`.
void resample(EdgeSamples& samples, double base, double spacing);

/// The same under sizes along the edges, at most `base`: samples at each of their places and, between, at most so many
/// sizes apart.
void resampleUnder(EdgeSamples& samples, double base, double spacing, const std::vector<EdgeSizes>& bounds);

/// Lowers sizes where an edge turns by more than a full turn / divisionsPerTurn within the size, or is farther than
/// mostSagitta (a length) from a chord of the size. Returns the least number of divisions per edge.
std::vector<std::int32_t> limitByTurning(EdgeSamples& samples, std::int32_t divisionsPerTurn, double lowest,
                                         double mostSagitta);

/// Lowers sizes on edges shorter than the size.
void limitByLength(EdgeSamples& samples, double lowest);

/// Where, straight across a face, another edge (or a far part of the same one) is nearer than `reach`; looked for from
/// places about `spacing` apart. Nothing when progress asked to stop.
std::optional<std::vector<Gap>> findGaps(const std::vector<EdgeCurve>& curves, const Brep& brep, double reach,
                                         double spacing, Progress& progress);

/// Where a gap is one element wide, `oneRow` of its sizes at most, gives both ends the geometric mean of their sizes: a
/// row of elements has no room for a change of their number from one side to the other.
void levelAcross(EdgeSamples& samples, const std::vector<Gap>& gaps, double oneRow);

}  // namespace qmcf
