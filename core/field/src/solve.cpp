#include "solve.hpp"

#include <algorithm>
#include <cmath>

#include "free_part.hpp"
#include "level.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/base/random.hpp"

namespace qmcf {
namespace {

constexpr double kShift = 1e-9;
constexpr int kInverseIterations = 60;

Error unsolvable() { return {ErrorCode::internal, "The cross field's linear system could not be solved.", {}}; }

/// What makes a singular energy positive definite.
double smallShift(const FieldMatrices& matrices) {
  return kShift * std::max(matrices.energy.diagonal().real().sum(), 1e-300) / matrices.area.sum();
}

NormalisedField onlyPins(const FieldConditions& conditions) {
  return {conditions.value, Eigen::VectorXd::Ones(conditions.value.size())};
}

NormalisedField withPins(const FieldConditions& conditions, const FreePart& free, const NormalisedField& unknowns) {
  NormalisedField all = onlyPins(conditions);
  free.insert(unknowns.field, all.field);
  for (Eigen::Index i = 0; i < free.size(); ++i) all.magnitude[free.vertex(i)] = unknowns.magnitude[i];
  return all;
}

/// Unknowns up to which the whole diffusion is done in full size.
constexpr Eigen::Index kDirectSize = 4000;
/// Length of the last time step on clusters, in units of their spacing.
constexpr double kClusterReach = 2.5;

}  // namespace

FieldConditions::FieldConditions(std::size_t vertexCount)
    : pinned(vertexCount, FieldPin::none),
      removed(vertexCount, 0),
      value(FieldVector::Zero(static_cast<Eigen::Index>(vertexCount))),
      pull(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(vertexCount))),
      guide(FieldVector::Zero(static_cast<Eigen::Index>(vertexCount))) {}

NormalisedField normalised(FieldVector field, const FieldVector& fallback) {
  NormalisedField result{std::move(field), Eigen::VectorXd(fallback.size())};
  for (Eigen::Index i = 0; i < fallback.size(); ++i) {
    const double length = std::sqrt(std::norm(result.field[i]));
    result.magnitude[i] = length;
    if (length > 1e-140) {
      result.field[i] /= length;
    } else {
      result.field[i] = fallback[i];
    }
  }
  return result;
}

bool FieldConditions::any() const {
  return pull.maxCoeff() > 0.0 ||
         std::any_of(pinned.begin(), pinned.end(), [](FieldPin p) { return p != FieldPin::none; });
}

Result<FieldVector> solveEliminated(const FieldMatrices& matrices, const FieldConditions& conditions) {
  const FreePart free(conditions.pinned);
  FieldVector field = conditions.value;
  if (free.size() == 0) return field;
  const Level level = finestLevel(matrices, conditions, free);
  const FieldFactor factor(level.energy);
  if (factor.info() != Eigen::Success) return unsolvable();
  free.insert(factor.solve(level.side), field);
  return field;
}

Result<FieldVector> solveLeastSquares(const FieldMatrices& matrices, const FieldConditions& conditions, double shift) {
  const FreePart free(conditions.pinned);
  FieldVector field = conditions.value;
  if (free.size() == 0) return field;
  const FieldMatrix system = matrices.energy - (shift - smallShift(matrices)) * matrices.mass;
  const FieldVector q = conditions.guide.cwiseProduct(conditions.pull.cast<Complex>());
  const FieldMatrix columns = free.columns(system);
  const FieldMatrix adjoint = columns.adjoint();
  const FieldMatrix square = adjoint * columns;
  FieldFactor factor(square);
  if (factor.info() != Eigen::Success) return unsolvable();
  const FieldVector side = matrices.mass * q - system * conditions.value;
  free.insert(factor.solve(adjoint * side), field);
  return field;
}

Result<Smoothest> solveSmoothest(const FieldMatrices& matrices, Progress& progress) {
  const Eigen::Index count = matrices.energy.rows();
  FieldFactor factor(matrices.energy + smallShift(matrices) * matrices.mass);
  if (factor.info() != Eigen::Success) return unsolvable();
  Random random(1);
  Smoothest result;
  result.field.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    result.field[i] = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
  }
  for (int iteration = 0; iteration < kInverseIterations; ++iteration) {
    if (!progress.report(Stage::field, 0.4 * iteration / kInverseIterations)) return cancelledError();
    FieldVector next = factor.solve(matrices.mass * result.field);
    next /= std::sqrt(next.dot(matrices.mass * next).real());
    const double eigenvalue = next.dot(matrices.energy * next).real();
    const bool settled = iteration > 10 && std::fabs(eigenvalue - result.eigenvalue) <= 1e-10 * eigenvalue;
    result.field = next;
    result.eigenvalue = eigenvalue;
    if (settled) break;
  }
  return result;
}

Result<NormalisedField> diffuse(const FieldMatrices& matrices, const FieldConditions& conditions,
                                const DiffusionSchedule& schedule, const FieldVector& field, Progress& progress) {
  const FreePart free(conditions.pinned);
  if (free.size() == 0) return onlyPins(conditions);
  const Level level = finestLevel(matrices, conditions, free);
  const double last = schedule.finalLength * schedule.finalLength;
  const Result<NormalisedField> unknowns =
      diffuseLevel(level, {firstTimeStep(level, last), last, 0.4, 0.9}, schedule, free.restrict(field), progress);
  if (!unknowns) return unknowns.error();
  return withPins(conditions, free, unknowns.value());
}

Result<NormalisedField> solveDiffused(const FieldMatrices& matrices, const FieldConditions& conditions,
                                      const DiffusionSchedule& schedule, Progress& progress) {
  const FreePart free(conditions.pinned);
  if (free.size() == 0) return onlyPins(conditions);
  const Level finest = finestLevel(matrices, conditions, free);
  std::vector<Clusters> coarser;
  const auto level = [&](std::size_t depth) -> const Level& { return depth == 0 ? finest : coarser[depth - 1].level; };
  while (level(coarser.size()).size() > kDirectSize) {
    if (!progress.report(Stage::field, 0.2)) return cancelledError();
    Clusters next = coarsen(level(coarser.size()));
    if (2 * next.level.size() > level(coarser.size()).size()) break;
    coarser.push_back(std::move(next));
  }
  std::size_t depth = coarser.size();
  Result<FieldVector> start = solveLevel(level(depth));
  if (!start) return start.error();
  FieldVector u = std::move(start).value();
  // Each level takes about four times as long as the coarser one before.
  const auto at = [&](std::size_t begun) {
    return begun > coarser.size() ? 0.2 : 0.2 + 0.7 / static_cast<double>(std::int64_t{1} << (2 * begun));
  };
  for (;; --depth) {
    const double reach =
        depth == 0 ? schedule.finalLength : std::max(schedule.finalLength, kClusterReach * level(depth).spacing());
    const double first = depth == coarser.size() ? firstTimeStep(level(depth), reach * reach) : reach * reach;
    const Result<NormalisedField> diffused =
        diffuseLevel(level(depth), {first, reach * reach, at(depth + 1), at(depth)}, schedule, u, progress);
    if (!diffused) return diffused.error();
    if (depth == 0) return withPins(conditions, free, diffused.value());
    u = coarser[depth - 1].spread(diffused.value().field);
  }
}

}  // namespace qmcf
