#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/field/cross_field.hpp"
#include "qmcf/mesh/patch.hpp"

namespace qmcf {

/// What can be said of the field of one patch, or of all patches of a part together.
struct FieldFigures {
  std::int64_t vertices = 0;
  std::int64_t positive = 0;  ///< Singularities of positive index.
  std::int64_t negative = 0;
  std::int64_t pairs = 0;         ///< Opposite quarter turns in the same patch, which Gauss-Bonnet does not ask for.
  std::int64_t nearBoundary = 0;  ///< Singularities less than one element from a boundary vertex.
  std::int64_t indexDefect = 0;   ///< Sum over the patches of how far each breaks Gauss-Bonnet.
  std::int64_t notFinite = 0;     ///< Crosses, corners and singularities that are no numbers or have another length.
  std::int64_t pinned = 0;
  std::int64_t removed = 0;
  double energy = 0.0;              ///< Eq. 1 of the paper: over all edges the square of the cross's turn, in radians.
  double boundaryDeviation = 0.0;   ///< Largest, degrees: see boundaryDeviation().
  double curvatureDeviation = 0.0;  ///< Sum over the reliable directions, degrees.
  std::int64_t reliable = 0;        ///< Vertices with reliable principal directions.

  void add(const FieldFigures& other);
};

/// Measures one field. reliable: a field of the same patch, pinned to curvature where that is reliable; its crosses
/// there are what curvatureDeviation compares with.
FieldFigures measureField(const Patch& patch, const CrossField& field, const CrossField& reliable);

/// The largest angle, in degrees, between the field and the pinned boundary edges:
/// - at every node in its unrolled fan, where corners are snapped to whole quarter turns;
/// - in space, at nodes inside an edge, from the tangent between the two chords;
/// - in space, in the middle of every chord, from the direction half-way between the tangents at its ends (the chord's
///   own on a straight edge); not in triangles with a second boundary edge, where the field turns from one to the
///   other.
double boundaryDeviation(const Patch& patch, const CrossField& field);

}  // namespace qmcf
