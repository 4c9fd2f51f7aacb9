#pragma once

#include <cstdint>
#include <vector>

#include "matrices.hpp"
#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/field/cross_field.hpp"

namespace qmcf {

/// What the crosses shall be: pinned ones, and directions that others are drawn to.
struct FieldConditions {
  explicit FieldConditions(std::size_t vertexCount);

  std::vector<FieldPin> pinned;       ///< Per vertex.
  std::vector<std::uint8_t> removed;  ///< Per vertex: 1 where a pin was taken back because it contradicted others.
  FieldVector value;                  ///< Per vertex: the cross it is pinned to; 0 where free.
  Eigen::VectorXd pull;               ///< Per vertex: weight per area of the pull towards `guide`, >= 0.
  FieldVector guide;                  ///< Per vertex: unit cross; 0 where there is no pull.

  [[nodiscard]] bool isPinned(VertexId v) const { return pinned[v.index()] != FieldPin::none; }
  /// Whether anything distinguishes one cross from another.
  [[nodiscard]] bool any() const;
};

/// How far the diffusion goes; lengths are in elements.
struct DiffusionSchedule {
  double finalLength = 2.5;  ///< Square root of the last time step.
  int stepsPerLevel = 25;
  double tolerance = 1e-3;  ///< Root mean square change of u at which a level ends.
};

/// Minimises u^H A u plus the pull, with the pinned crosses given.
/// \pre conditions.any(). Errors: internal.
Result<FieldVector> solveEliminated(const FieldMatrices& matrices, const FieldConditions& conditions);

/// The paper's system (3.2.2): least squares of (A - shift M) u = M q over the unknowns, with every row kept. q is the
/// guide weighted by the pull. \pre conditions.any(). Errors: internal.
Result<FieldVector> solveLeastSquares(const FieldMatrices& matrices, const FieldConditions& conditions, double shift);

/// The unit vector of least energy where nothing is pinned and nothing pulls, by inverse iteration.
struct Smoothest {
  FieldVector field;  ///< field^H mass field = 1.
  double eigenvalue = 0.0;
};
Result<Smoothest> solveSmoothest(const FieldMatrices& matrices, Progress& progress);

/// Crosses of length 1 and the lengths that they had before.
struct NormalisedField {
  FieldVector field;
  Eigen::VectorXd magnitude;
};

/// Every entry to length 1; entries too short to have a direction take the one of `fallback`.
NormalisedField normalised(FieldVector field, const FieldVector& fallback);

/// Diffuses and renormalises in turn, with time steps from the size of the patch down to the schedule's last
/// (Merriman-Bence-Osher; Viertel and Osting 2017; B2 of docs/algorithm.md). Time is measured in elements, so that the
/// distance that singularities keep from walls follows the size field. field: |u| = 1.
/// Errors: cancelled, internal.
Result<NormalisedField> diffuse(const FieldMatrices& matrices, const FieldConditions& conditions,
                                const DiffusionSchedule& schedule, const FieldVector& field, Progress& progress);

/// solveEliminated() or solveSmoothest() followed by diffuse(), but on large patches from coarse to fine: the long time
/// steps, and the linear solve that they start from, are taken on clusters of vertices. One factorisation in full size.
/// Errors: cancelled, internal.
Result<NormalisedField> solveDiffused(const FieldMatrices& matrices, const FieldConditions& conditions,
                                      const DiffusionSchedule& schedule, Progress& progress);

}  // namespace qmcf
