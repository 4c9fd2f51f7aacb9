#include "qmcf/field/cross_field.hpp"

#include <algorithm>
#include <cassert>

#include "cancel_pairs.hpp"
#include "constraints.hpp"
#include "frames.hpp"
#include "interpolate.hpp"
#include "singularities.hpp"
#include "solve.hpp"

namespace qmcf {
namespace {

constexpr int kRemovalRounds = 5;

FieldMatrices assemble(const Patch& patch, const Connection& connection, const FieldOptions& options) {
  if (options.energy == FieldEnergy::cotangent) return assembleCotangent(patch, connection);
  return assembleFiniteElements(patch, connection, std::clamp(options.smoothness, -1.0, 1.0));
}

/// The linear solve; every cross of length 1.
Result<Smoothest> solveLinear(const FieldMatrices& matrices, const FieldConditions& conditions,
                              const FieldOptions& options, Progress& progress) {
  if (!conditions.any()) return solveSmoothest(matrices, progress);
  Result<FieldVector> solved = options.solver == FieldSolver::leastSquares
                                   ? solveLeastSquares(matrices, conditions, std::min(options.shift, 0.0))
                                   : solveEliminated(matrices, conditions);
  if (!solved) return solved.error();
  return Smoothest{std::move(solved).value(), 0.0};
}

/// The crosses, of length 1, as the options want them solved.
Result<Smoothest> solveField(const FieldMatrices& matrices, const FieldConditions& conditions,
                             const FieldOptions& options, Progress& progress) {
  DiffusionSchedule schedule;
  schedule.finalLength = options.diffusionLength;
  if (options.diffuse && options.solver == FieldSolver::eliminate) {
    Result<FieldVector> solved = solveDiffused(matrices, conditions, schedule, progress);
    if (!solved) return solved.error();
    return Smoothest{std::move(solved).value(), 0.0};
  }
  Result<Smoothest> solved = solveLinear(matrices, conditions, options, progress);
  if (!solved) return solved.error();
  FieldVector& u = solved.value().field;
  normaliseCrosses(u, FieldVector::Ones(u.size()));
  if (options.diffuse) {
    const Result<Done> diffused = diffuse(matrices, conditions, schedule, u, progress);
    if (!diffused) return diffused.error();
  }
  return solved;
}

/// Adds what curvature says: pull and, where it is reliable and consistent, pins.
void addCurvature(const Patch& patch, const Connection& connection, const FieldMatrices& matrices,
                  const FieldOptions& options, FieldConditions& conditions) {
  if (!options.curvature || !curvatureMatters(patch, matrices)) return;
  const CurvatureField curvature = estimateCurvature(patch, connection);
  if (options.pinCurvature) {
    pinCurvature(patch, curvature, options, conditions);
    for (int round = 0; round < kRemovalRounds; ++round) {
      if (removeInconsistentPins(patch, connection, conditions) == 0) break;
    }
  }
  pullToCurvature(patch, curvature, options, conditions);
}

}  // namespace

Result<CrossField> computeCrossField(const Patch& patch, const std::vector<std::uint8_t>& edgeKinds,
                                     const FieldOptions& options, Progress& progress) {
  if (!progress.report(Stage::field, 0.0)) return cancelledError();
  const Surface& surface = patch.surface;
  const Connection connection = buildConnection(patch);
  const IdMap<VertexId, TangentFrame> frames = tangentFrames(patch, connection);
  const FieldMatrices matrices = assemble(patch, connection, options);
  FieldConditions conditions(surface.vertexCount());
  pinBoundary(patch, edgeKinds, options, conditions);
  pinStrokes(patch, frames, options.strokes, conditions);
  addCurvature(patch, connection, matrices, options, conditions);
  if (!progress.report(Stage::field, 0.1)) return cancelledError();

  Result<Smoothest> solved = solveField(matrices, conditions, options, progress);
  if (!solved) return solved.error();
  FieldVector& u = solved.value().field;
  if (options.cancelDistance > 0.0) {
    const Result<std::int32_t> removed =
        cancelPairs(patch, connection, matrices, conditions, options.cancelDistance, u, progress);
    if (!removed) return removed.error();
  }

  CrossField field;
  field.frame = frames;
  field.constrained.raw() = conditions.pinned;
  field.removed.raw() = conditions.removed;
  field.eigenvalue = solved.value().eigenvalue;
  field.cross.raw().assign(u.data(), u.data() + u.size());
  field.energy = 0.5 * u.dot(matrices.energy * u).real();
  field.index = triangleIndices(surface, connection, field.cross);
  fillCorners(patch, connection, field);
  field.singularities = locateSingularities(field);
  assert(gaussBonnetDefect(patch, field) == 0);
  if (!progress.report(Stage::field, 1.0)) return cancelledError();
  return field;
}

}  // namespace qmcf
