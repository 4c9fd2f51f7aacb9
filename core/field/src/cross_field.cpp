#include "qmcf/field/cross_field.hpp"

#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "cancel_pairs.hpp"
#include "constraints.hpp"
#include "frames.hpp"
#include "interpolate.hpp"
#include "singularities.hpp"
#include "solve.hpp"

namespace qmcf {
namespace {

FieldMatrices assemble(const Patch& patch, const Connection& connection, const FieldOptions& options) {
  if (options.energy == FieldEnergy::cotangent) return assembleCotangent(patch, connection);
  return assembleFiniteElements(patch, connection, options.smoothness);
}

/// Crosses of length 1, their lengths before, and the eigenvalue if it was one that was solved for.
struct SolvedField {
  NormalisedField crosses;
  double eigenvalue = 0.0;
};

/// The linear solve.
Result<Smoothest> solveLinear(const FieldMatrices& matrices, const FieldConditions& conditions,
                              const FieldOptions& options, Progress& progress) {
  if (!conditions.any()) {
    Result<Smoothest> smoothest = solveSmoothest(matrices, progress);
    if (smoothest) smoothest.value().field *= std::sqrt(matrices.area.sum());
    return smoothest;
  }
  Result<FieldVector> solved = options.solver == FieldSolver::leastSquares
                                   ? solveLeastSquares(matrices, conditions, options.shift)
                                   : solveEliminated(matrices, conditions);
  if (!solved) return solved.error();
  return Smoothest{std::move(solved).value(), 0.0};
}

/// The crosses as the options want them solved.
Result<SolvedField> solveField(const FieldMatrices& matrices, const FieldConditions& conditions,
                               const FieldOptions& options, Progress& progress) {
  DiffusionSchedule schedule;
  schedule.finalLength = options.diffusionLength;
  if (options.diffuse && options.solver == FieldSolver::eliminate) {
    Result<NormalisedField> solved = solveDiffused(matrices, conditions, schedule, progress);
    if (!solved) return solved.error();
    return SolvedField{std::move(solved).value(), 0.0};
  }
  Result<Smoothest> solved = solveLinear(matrices, conditions, options, progress);
  if (!solved) return solved.error();
  FieldVector& u = solved.value().field;
  const FieldVector ones = FieldVector::Ones(u.size());
  SolvedField result{normalised(std::move(u), ones), solved.value().eigenvalue};
  if (!options.diffuse) return result;
  Result<NormalisedField> diffused = diffuse(matrices, conditions, schedule, result.crosses.field, progress);
  if (!diffused) return diffused.error();
  return SolvedField{std::move(diffused).value(), 0.0};
}

std::vector<std::uint8_t> pinnedVertices(const FieldConditions& conditions) {
  std::vector<std::uint8_t> pinned;
  pinned.reserve(conditions.pinned.size());
  for (const FieldPin pin : conditions.pinned) pinned.push_back(pin == FieldPin::none ? 0 : 1);
  return pinned;
}

/// Solves, and where pins to curvature turn out to contradict what is around them, takes these back and solves again
/// (section 3.2.3), until none does: every round frees at least one.
Result<SolvedField> solveConsistently(const Patch& patch, const Connection& connection, const FieldMatrices& matrices,
                                      const CurvatureField* curvature, const FieldOptions& options,
                                      FieldConditions& conditions, Progress& progress) {
  const bool removes = curvature != nullptr && options.pinCurvature && options.removeInconsistent;
  if (removes) {
    removeInconsistentPins(patch, connection, conditions.value, pinnedVertices(conditions), conditions);
  }
  for (;;) {
    if (curvature != nullptr) pullToCurvature(patch, *curvature, options, conditions);
    Result<SolvedField> solved = solveField(matrices, conditions, options, progress);
    if (!solved) return solved;
    FieldVector& u = solved.value().crosses.field;
    if (options.cancelDistance > 0.0) {
      const Result<std::int32_t> cancelled =
          cancelPairs(patch, connection, matrices, conditions, options.cancelDistance, u, progress);
      if (!cancelled) return cancelled.error();
    }
    const std::vector<std::uint8_t> all(patch.surface.vertexCount(), 1);
    if (!removes || removeInconsistentPins(patch, connection, u, all, conditions) == 0) return solved;
  }
}

std::optional<Error> validate(const FieldOptions& options) {
  const auto demand = [](bool holds, const char* sentence) {
    return holds ? std::nullopt : std::optional<Error>(Error{ErrorCode::invalidOption, sentence, {}});
  };
  // Written so that NaN fails.
  for (const auto& error :
       {demand(options.smoothness >= -1.0 && options.smoothness <= 1.0, "smoothness must be between -1 and 1."),
        demand(options.smoothness == 0.0 || options.energy == FieldEnergy::finiteElements,
               "A smoothness other than 0 needs the energy of finite elements."),
        demand(options.shift <= 0.0, "shift must not be positive."),
        demand(options.guidance >= 0.0, "guidance must not be negative."),
        demand(options.pinAnisotropy >= 0.0 && options.pinAnisotropy <= 1.0, "pinAnisotropy must be between 0 and 1."),
        demand(options.pinTurn >= 0.0, "pinTurn must not be negative."),
        demand(options.denseBoundary >= 0.0, "denseBoundary must not be negative."),
        demand(options.diffusionLength > 0.0, "diffusionLength must be positive."),
        demand(options.cancelDistance >= 0.0, "cancelDistance must not be negative.")}) {
    if (error) return error;
  }
  return std::nullopt;
}

}  // namespace

Result<CrossField> computeCrossField(const Patch& patch, const std::vector<std::uint8_t>& edgeKinds,
                                     const FieldOptions& options, Progress& progress) {
  if (std::optional<Error> error = validate(options)) return *std::move(error);
  if (!progress.report(Stage::field, 0.0)) return cancelledError();
  const Surface& surface = patch.surface;
  Connection connection = buildConnection(patch);
  if (options.followSizes) followSizes(patch, connection);
  const IdMap<VertexId, TangentFrame> frames = tangentFrames(patch, connection);
  const FieldMatrices matrices = assemble(patch, connection, options);
  FieldConditions conditions(surface.vertexCount());
  pinBoundary(patch, edgeKinds, options, conditions);
  pinStrokes(patch, frames, options.strokes, conditions);
  std::optional<CurvatureField> curvature;
  if (options.curvature &&
      (options.denseBoundary <= 0.0 || boundaryDensity(patch, matrices) <= options.denseBoundary)) {
    curvature = estimateCurvature(patch, connection);
    if (options.pinCurvature) pinCurvature(patch, *curvature, options, conditions);
  }
  if (!progress.report(Stage::field, 0.1)) return cancelledError();

  Result<SolvedField> solved =
      solveConsistently(patch, connection, matrices, curvature ? &*curvature : nullptr, options, conditions, progress);
  if (!solved) return solved.error();
  const auto& [crosses, eigenvalue] = solved.value();
  const FieldVector& u = crosses.field;

  CrossField field;
  field.frame = frames;
  field.constrained.raw() = conditions.pinned;
  field.removed.raw() = conditions.removed;
  field.eigenvalue = eigenvalue;
  field.cross.raw().assign(u.data(), u.data() + u.size());
  field.magnitude.raw().assign(crosses.magnitude.data(), crosses.magnitude.data() + u.size());
  field.energy = 0.5 * u.dot(matrices.energy * u).real();
  field.index = triangleIndices(surface, connection, field.cross);
  fillCorners(patch, connection, field);
  field.singularities = locateSingularities(field);
  assert(gaussBonnetDefect(patch, field) == 0);
  if (!progress.report(Stage::field, 1.0)) return cancelledError();
  return field;
}

}  // namespace qmcf
