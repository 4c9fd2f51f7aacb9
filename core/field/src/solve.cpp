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

/// Unknowns up to which the whole diffusion is done in full size.
constexpr Eigen::Index kDirectSize = 4000;
/// Length of the last time step on clusters, in units of their spacing.
constexpr double kClusterReach = 2.5;

}  // namespace

FieldConditions::FieldConditions(std::size_t vertexCount)
    : pinned(vertexCount, 0),
      removed(vertexCount, 0),
      value(FieldVector::Zero(static_cast<Eigen::Index>(vertexCount))),
      pull(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(vertexCount))),
      guide(FieldVector::Zero(static_cast<Eigen::Index>(vertexCount))) {}

void normaliseCrosses(FieldVector& field, const FieldVector& fallback) {
  for (Eigen::Index i = 0; i < field.size(); ++i) {
    const double length = std::sqrt(std::norm(field[i]));
    if (length > 1e-140) {
      field[i] /= length;
    } else {
      field[i] = fallback[i];
    }
  }
}

bool FieldConditions::any() const {
  return pull.maxCoeff() > 0.0 || std::any_of(pinned.begin(), pinned.end(), [](auto p) { return p != 0; });
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
  FieldVector q = conditions.guide.cwiseProduct(conditions.pull.cast<Complex>());
  const double length = std::sqrt(q.dot(matrices.mass * q).real());
  if (length > 0.0) q /= length;
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

Result<Done> diffuse(const FieldMatrices& matrices, const FieldConditions& conditions,
                     const DiffusionSchedule& schedule, FieldVector& field, Progress& progress) {
  const FreePart free(conditions.pinned);
  if (free.size() == 0) return Done{};
  const Level level = finestLevel(matrices, conditions, free);
  const double last = schedule.finalLength * schedule.finalLength;
  FieldVector unknowns = free.restrict(field);
  const Result<Done> done =
      diffuseLevel(level, {firstTimeStep(level, last), last, 0.4, 0.9}, schedule, unknowns, progress);
  if (!done) return done.error();
  free.insert(unknowns, field);
  return Done{};
}

Result<FieldVector> solveDiffused(const FieldMatrices& matrices, const FieldConditions& conditions,
                                  const DiffusionSchedule& schedule, Progress& progress) {
  const FreePart free(conditions.pinned);
  FieldVector field = conditions.value;
  if (free.size() == 0) return field;
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
  Result<FieldVector> unknowns = solveLevel(level(depth));
  if (!unknowns) return unknowns.error();
  FieldVector& u = unknowns.value();
  // Each level takes about four times as long as the coarser one before.
  const auto at = [&](std::size_t begun) {
    return begun > coarser.size() ? 0.2 : 0.2 + 0.7 / static_cast<double>(std::int64_t{1} << (2 * begun));
  };
  for (;; --depth) {
    const double reach =
        depth == 0 ? schedule.finalLength : std::max(schedule.finalLength, kClusterReach * level(depth).spacing());
    const double first = depth == coarser.size() ? firstTimeStep(level(depth), reach * reach) : reach * reach;
    const Result<Done> done =
        diffuseLevel(level(depth), {first, reach * reach, at(depth + 1), at(depth)}, schedule, u, progress);
    if (!done) return done.error();
    if (depth == 0) break;
    u = coarser[depth - 1].spread(u);
  }
  free.insert(u, field);
  return field;
}

}  // namespace qmcf
