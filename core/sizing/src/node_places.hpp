#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/sizing/edge_curve.hpp"
#include "qmcf/sizing/size_field.hpp"

namespace qmcf {

/// An edge of the B-rep with what its nodes are placed by.
struct PlacedCurve {
  EdgeCurve curve;
  EdgeSizes sizes;
  std::vector<double> integral;     ///< Per sample of sizes: the integral of ds / h from the start.
  std::vector<double> sought;       ///< Arc lengths where nodes are wanted as they are at stops; ascending.
  std::vector<std::int32_t> stops;  ///< Points of the curve that should be nodes, ascending.
  double chordSize = 0.0;           ///< As in SizeField.

  /// The number of divisions wanted: the integral over the whole edge.
  [[nodiscard]] double wanted() const { return integral.back(); }
};

struct NodePlaces {
  std::vector<double> arcLength;  ///< Both ends included, ascending.
  double sagitta = 0.0;  ///< Largest distance of the edge from its chords, in units of the size there or of chordSize.
};

/// Places the nodes of `count` divisions: at equal parts of the integral, moved by less than half a part such that
/// chords stay near the edge, corners of coarse polygons and stops become nodes. Least squares by dynamic programming;
/// complexity O(count + points). \pre count >= 1
NodePlaces placeNodesOnCurve(const PlacedCurve& placed, std::int32_t count);

}  // namespace qmcf
