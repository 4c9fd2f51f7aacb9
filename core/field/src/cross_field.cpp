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

/// The field of least energy, every cross of length 1.
Result<FieldVector> solveField(const FieldMatrices& matrices, const FieldConditions& conditions, Progress& progress) {
  const bool pinned = std::any_of(conditions.pinned.begin(), conditions.pinned.end(), [](auto p) { return p != 0; });
  FieldVector field;
  if (pinned || conditions.pull.maxCoeff() > 0.0) {
    Result<FieldVector> solved = solveEliminated(matrices, conditions);
    if (!solved) return solved.error();
    field = std::move(solved).value();
  } else {
    Result<Smoothest> solved = solveSmoothest(matrices, progress);
    if (!solved) return solved.error();
    field = std::move(solved.value().field);
  }
  normaliseCrosses(field, FieldVector::Ones(field.size()));
  return field;
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
  pullToCurvature(patch, curvature, options.guidance, conditions);
}

}  // namespace

Result<CrossField> computeCrossField(const Patch& patch, const std::vector<std::uint8_t>& edgeKinds,
                                     const FieldOptions& options, Progress& progress) {
  if (!progress.report(Stage::field, 0.0)) return cancelledError();
  const Surface& surface = patch.surface;
  const Connection connection = buildConnection(patch);
  const FieldMatrices matrices = assembleCotangent(patch, connection);
  FieldConditions conditions = freeConditions(surface.vertexCount());
  pinBoundary(patch, edgeKinds, options, conditions);
  addCurvature(patch, connection, matrices, options, conditions);
  if (!progress.report(Stage::field, 0.1)) return cancelledError();

  Result<FieldVector> solved = solveField(matrices, conditions, progress);
  if (!solved) return solved.error();
  FieldVector& u = solved.value();
  if (options.diffuse) {
    DiffusionSchedule schedule;
    schedule.finalLength = options.diffusionLength;
    const Result<Done> diffused = diffuse(matrices, conditions, schedule, u, progress);
    if (!diffused) return diffused.error();
  }
  if (options.cancelDistance > 0.0) {
    const Result<std::int32_t> removed =
        cancelPairs(patch, connection, matrices, conditions, options.cancelDistance, u, progress);
    if (!removed) return removed.error();
  }

  CrossField field;
  field.frame = tangentFrames(patch, connection);
  field.constrained.raw() = conditions.pinned;
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
