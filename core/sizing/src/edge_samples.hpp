#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/sizing/edge_curve.hpp"
#include "qmcf/sizing/size_field.hpp"

namespace qmcf {

/// The edges of a B-rep with their sizes under construction.
struct EdgeSamples {
  std::vector<EdgeCurve> curves;  ///< Per edge.
  std::vector<EdgeSizes> sizes;   ///< Per edge.
  double base = 0.0;

  /// Lowers the sizes at the samples on both sides of arc length s.
  void lower(std::int32_t edge, double s, double size);
};

/// Samples at each point of every edge and, between points, at most `spacing` apart, all with the size `base`.
EdgeSamples sampleEdges(const TriangleMesh& mesh, const Brep& brep, double base, double spacing);

/// Lowers sizes where an edge turns by more than a full turn / divisionsPerTurn within the size.
/// Returns the least number of divisions per edge.
std::vector<std::int32_t> limitByTurning(EdgeSamples& samples, std::int32_t divisionsPerTurn, double lowest);

/// Lowers sizes on edges shorter than the size.
void limitByLength(EdgeSamples& samples, double lowest);

/// Lowers sizes where, straight across a face, another edge (or a far part of the same one) is nearer than the size.
/// Returns false when progress asked to stop.
bool limitByProximity(EdgeSamples& samples, const TriangleMesh& mesh, const Brep& brep, double lowest,
                      Progress& progress);

/// Limits the slope of the sizes, along edges and straight across the faces beside them.
void gradeEdges(EdgeSamples& samples, const Brep& brep, double gradation);

}  // namespace qmcf
