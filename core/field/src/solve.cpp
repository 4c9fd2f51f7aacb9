#include "solve.hpp"

#include <algorithm>
#include <cmath>

#include "free_part.hpp"
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

/// The energy of the unknowns, plus the pull.
FieldMatrix pulledEnergy(const FieldMatrices& matrices, const FieldConditions& conditions, const FreePart& free) {
  FieldMatrix system = free.block(matrices.energy);
  for (Eigen::Index i = 0; i < free.size(); ++i) {
    const Eigen::Index v = free.vertex(i);
    system.coeffRef(i, i) += conditions.pull[v] * matrices.area[v];
  }
  return system;
}

FieldVector pullSide(const FieldMatrices& matrices, const FieldConditions& conditions, const FreePart& free) {
  FieldVector side(free.size());
  for (Eigen::Index i = 0; i < free.size(); ++i) {
    const Eigen::Index v = free.vertex(i);
    side[i] = conditions.pull[v] * matrices.area[v] * conditions.guide[v];
  }
  return side;
}

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

Result<FieldVector> solveEliminated(const FieldMatrices& matrices, const FieldConditions& conditions) {
  const FreePart free(conditions.pinned);
  FieldVector field = conditions.value;
  if (free.size() == 0) return field;
  FieldFactor factor(pulledEnergy(matrices, conditions, free));
  if (factor.info() != Eigen::Success) return unsolvable();
  const FieldVector side = pullSide(matrices, conditions, free) - free.given(matrices.energy, conditions.value);
  free.insert(factor.solve(side), field);
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
  const FieldMatrix energy = pulledEnergy(matrices, conditions, free);
  const FieldVector side = pullSide(matrices, conditions, free) - free.given(matrices.energy, conditions.value);
  Eigen::VectorXd cells(free.size());
  for (Eigen::Index i = 0; i < free.size(); ++i) cells[i] = matrices.cells[free.vertex(i)];

  // The first step reaches a fifth of the radius of the disk of the same area.
  const double last = schedule.finalLength * schedule.finalLength;
  const double first = std::max(last, 0.04 / math::kPi * matrices.cells.sum());
  const int levels = 1 + static_cast<int>(std::floor(math::log(first / last) / math::log(schedule.factor) + 0.5));
  FieldFactor factor;
  factor.analyzePattern(energy);
  FieldVector current = free.restrict(field);
  double time = last;
  for (int level = 1; level < levels; ++level) time *= schedule.factor;
  for (int level = 0; level < levels; ++level, time /= schedule.factor) {
    FieldMatrix system = time * energy;
    for (Eigen::Index i = 0; i < free.size(); ++i) system.coeffRef(i, i) += cells[i];
    factor.factorize(system);
    if (factor.info() != Eigen::Success) return unsolvable();
    for (int step = 0; step < schedule.stepsPerLevel; ++step) {
      const double done = (level + static_cast<double>(step) / schedule.stepsPerLevel) / levels;
      if (!progress.report(Stage::field, 0.4 + 0.5 * done)) return cancelledError();
      FieldVector next = factor.solve(cells.cwiseProduct(current) + time * side);
      normaliseCrosses(next, current);
      const double change = std::sqrt((next - current).squaredNorm() / static_cast<double>(free.size()));
      current.swap(next);
      if (change < schedule.tolerance) break;
    }
  }
  free.insert(current, field);
  return Done{};
}

}  // namespace qmcf
