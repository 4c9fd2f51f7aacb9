#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "free_part.hpp"
#include "solve.hpp"

namespace qmcf {

/// The unknown crosses of a patch, or clusters of them, with the energy u^H energy u - 2 Re(side^H u).
struct Level {
  FieldMatrix energy;
  FieldVector side;       ///< From pinned neighbours and pulls.
  Eigen::VectorXd cells;  ///< Area in elements.

  [[nodiscard]] Eigen::Index size() const { return cells.size(); }
  /// Mean distance between neighbours, in elements.
  [[nodiscard]] double spacing() const;
};

/// The unknowns of a patch.
Level finestLevel(const FieldMatrices& matrices, const FieldConditions& conditions, const FreePart& free);

/// Clusters of about seven neighbours each, and how their crosses follow from the cluster's.
struct Clusters {
  std::vector<int> cluster;   ///< Per unknown.
  std::vector<Complex> move;  ///< Per unknown: from the cluster's cross to its own.
  Level level;                ///< The clusters as unknowns.

  [[nodiscard]] FieldVector spread(const FieldVector& coarse) const;
};
Clusters coarsen(const Level& level);

/// Least energy: of the linear system where there is a side, else of a unit vector; every cross of length 1.
Result<FieldVector> solveLevel(const Level& level);

/// Time steps of a diffusion, each a quarter of the one before, and the part of the field's progress that it is.
struct DiffusionSpan {
  double firstStep = 0.0;
  double lastStep = 0.0;
  double from = 0.0;
  double to = 1.0;
};

/// Diffuses and renormalises, from crosses of length 1.
Result<NormalisedField> diffuseLevel(const Level& level, const DiffusionSpan& span, const DiffusionSchedule& schedule,
                                     const FieldVector& start, Progress& progress);

/// What the diffusion starts with: a fifth of the radius of the disk of the same area.
double firstTimeStep(const Level& level, double last);

}  // namespace qmcf
