#pragma once

#include <cstdint>
#include <vector>

#include "matrices.hpp"
#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"

namespace qmcf {

/// What the crosses shall be: pinned ones, and directions that others are drawn to.
struct FieldConditions {
  explicit FieldConditions(std::size_t vertexCount);

  std::vector<std::uint8_t> pinned;   ///< Per vertex: 0 free, else why pinned (CrossField::constrained).
  std::vector<std::uint8_t> removed;  ///< Per vertex: 1 where a pin was taken back because it contradicted others.
  FieldVector value;                  ///< Per vertex: the cross it is pinned to; 0 where free.
  Eigen::VectorXd pull;               ///< Per vertex: weight per area of the pull towards `guide`, >= 0.
  FieldVector guide;                  ///< Per vertex: unit cross; 0 where there is no pull.

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
/// guide weighted by the pull, of length 1. \pre conditions.any(). Errors: internal.
Result<FieldVector> solveLeastSquares(const FieldMatrices& matrices, const FieldConditions& conditions, double shift);

/// The unit vector of least energy where nothing is pinned and nothing pulls, by inverse iteration.
struct Smoothest {
  FieldVector field;
  double eigenvalue = 0.0;
};
Result<Smoothest> solveSmoothest(const FieldMatrices& matrices, Progress& progress);

/// Diffuses and renormalises in turn, with time steps from the size of the patch down to the schedule's last
/// (Merriman-Bence-Osher; Viertel and Osting 2017; B2 of docs/algorithm.md). Time is measured in elements, so that the
/// distance that singularities keep from walls follows the size field. field: |u| = 1, improved in place.
/// Errors: cancelled, internal.
Result<Done> diffuse(const FieldMatrices& matrices, const FieldConditions& conditions,
                     const DiffusionSchedule& schedule, FieldVector& field, Progress& progress);

/// solveEliminated() or solveSmoothest() followed by diffuse(), but on large patches from coarse to fine: the long time
/// steps, and the linear solve that they start from, are taken on clusters of vertices. One factorisation in full size.
/// Errors: cancelled, internal.
Result<FieldVector> solveDiffused(const FieldMatrices& matrices, const FieldConditions& conditions,
                                  const DiffusionSchedule& schedule, Progress& progress);

/// Every entry to length 1; entries too short to have a direction take the one of `fallback`.
void normaliseCrosses(FieldVector& field, const FieldVector& fallback);

}  // namespace qmcf
