#include "level.hpp"

#include <algorithm>
#include <cmath>

#include "qmcf/base/math.hpp"
#include "qmcf/base/random.hpp"
#include "time_step.hpp"

namespace qmcf {
namespace {

constexpr double kTimeFactor = 4.0;
constexpr int kInverseIterations = 20;

Error unsolvable() { return {ErrorCode::internal, "The cross field's diffusion could not be solved.", {}}; }

/// Joins every unknown to a seed next to it, or else to the cluster of its strongest neighbour.
void formClusters(const Level& level, Clusters& clusters) {
  const Eigen::Index count = level.size();
  clusters.cluster.assign(static_cast<std::size_t>(count), kNone);
  clusters.move.assign(static_cast<std::size_t>(count), 1.0);
  const auto clusterOf = [&](Eigen::Index i) -> int& { return clusters.cluster[static_cast<std::size_t>(i)]; };
  const auto join = [&](Eigen::Index i, Eigen::Index neighbour, Complex entry) {
    clusterOf(i) = clusterOf(neighbour);
    clusters.move[static_cast<std::size_t>(i)] =
        math::normalized(-entry) * clusters.move[static_cast<std::size_t>(neighbour)];
  };
  int number = 0;
  for (Eigen::Index seed = 0; seed < count; ++seed) {
    bool free = clusterOf(seed) == kNone;
    for (FieldMatrix::InnerIterator it(level.energy, seed); free && it; ++it) free = clusterOf(it.row()) == kNone;
    if (!free) continue;
    clusterOf(seed) = number++;
    for (FieldMatrix::InnerIterator it(level.energy, seed); it; ++it) {
      if (it.row() != seed) join(it.row(), seed, it.value());
    }
  }
  const std::vector<int> seeded = clusters.cluster;
  for (Eigen::Index i = 0; i < count; ++i) {
    if (clusterOf(i) != kNone) continue;
    Eigen::Index strongest = -1;
    Complex entry = 0.0;
    for (FieldMatrix::InnerIterator it(level.energy, i); it; ++it) {
      // Column i holds the entries (neighbour, i); the entry (i, neighbour) is the conjugate.
      const bool usable = it.row() != i && seeded[static_cast<std::size_t>(it.row())] != kNone;
      if (usable && std::norm(it.value()) > std::norm(entry)) {
        strongest = it.row();
        entry = std::conj(it.value());
      }
    }
    if (strongest >= 0) {
      join(i, strongest, entry);
    } else {
      clusterOf(i) = number++;
    }
  }
}

}  // namespace

double Level::spacing() const {
  return std::sqrt(cells.sum() / static_cast<double>(std::max<Eigen::Index>(1, size())));
}

Level finestLevel(const FieldMatrices& matrices, const FieldConditions& conditions, const FreePart& free) {
  Level level{free.block(matrices.energy), -free.given(matrices.energy, conditions.value),
              Eigen::VectorXd(free.size())};
  for (Eigen::Index i = 0; i < free.size(); ++i) {
    const Eigen::Index v = free.vertex(i);
    const double pull = conditions.pull[v] * matrices.area[v];
    level.energy.coeffRef(i, i) += pull;
    level.side[i] += pull * conditions.guide[v];
    level.cells[i] = matrices.cells[v];
  }
  return level;
}

FieldVector Clusters::spread(const FieldVector& coarse) const {
  FieldVector fine(static_cast<Eigen::Index>(cluster.size()));
  for (std::size_t i = 0; i < cluster.size(); ++i) fine[static_cast<Eigen::Index>(i)] = move[i] * coarse[cluster[i]];
  return fine;
}

Clusters coarsen(const Level& level) {
  Clusters clusters;
  formClusters(level, clusters);
  const int count = 1 + *std::max_element(clusters.cluster.begin(), clusters.cluster.end());
  clusters.level.side = FieldVector::Zero(count);
  clusters.level.cells = Eigen::VectorXd::Zero(count);
  // Crosses constant in each cluster change all at once between clusters, which costs more energy than an even change,
  // by the width of a cluster.
  const double stiffness = std::sqrt(static_cast<double>(level.size()) / count);
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(static_cast<std::size_t>(level.energy.nonZeros()));
  for (Eigen::Index column = 0; column < level.size(); ++column) {
    const int to = clusters.cluster[static_cast<std::size_t>(column)];
    const Complex move = clusters.move[static_cast<std::size_t>(column)];
    clusters.level.side[to] += std::conj(move) * level.side[column] / stiffness;
    clusters.level.cells[to] += level.cells[column];
    for (FieldMatrix::InnerIterator it(level.energy, column); it; ++it) {
      const auto row = static_cast<std::size_t>(it.row());
      entries.emplace_back(clusters.cluster[row], to, std::conj(clusters.move[row]) * it.value() * move / stiffness);
    }
  }
  clusters.level.energy.resize(count, count);
  clusters.level.energy.setFromTriplets(entries.begin(), entries.end());
  return clusters;
}

Result<FieldVector> solveLevel(const Level& level) {
  const FieldVector ones = FieldVector::Ones(level.size());
  FieldVector field;
  if (level.side.squaredNorm() > 0.0) {
    const FieldFactor factor(level.energy);
    if (factor.info() != Eigen::Success) return unsolvable();
    field = factor.solve(level.side);
  } else {
    FieldMatrix system = level.energy;
    const double shift = 1e-9 * level.energy.diagonal().real().sum() / level.cells.sum();
    for (Eigen::Index i = 0; i < level.size(); ++i) system.coeffRef(i, i) += shift * level.cells[i];
    const FieldFactor factor(system);
    if (factor.info() != Eigen::Success) return unsolvable();
    Random random(1);
    field.resize(level.size());
    for (Complex& u : field) u = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    for (int iteration = 0; iteration < kInverseIterations; ++iteration) {
      field = factor.solve(level.cells.cast<Complex>().cwiseProduct(field)).eval();
      field /= field.norm();
    }
  }
  return normalised(std::move(field), ones).field;
}

double firstTimeStep(const Level& level, double last) { return std::max(last, 0.04 / math::kPi * level.cells.sum()); }

Result<NormalisedField> diffuseLevel(const Level& level, const DiffusionSpan& span, const DiffusionSchedule& schedule,
                                     const FieldVector& start, Progress& progress) {
  const double ratio = math::log(span.firstStep / span.lastStep) / math::log(kTimeFactor);
  const int rounds = 1 + static_cast<int>(std::floor(ratio + 0.5));
  NormalisedField now{start, Eigen::VectorXd::Ones(start.size())};
  double time = span.lastStep;
  for (int round = 1; round < rounds; ++round) time *= kTimeFactor;
  for (int round = 0; round < rounds; ++round, time /= kTimeFactor) {
    TimeStep timeStep(level, time);
    if (!timeStep.ok()) return unsolvable();
    for (int step = 0; step < schedule.stepsPerLevel; ++step) {
      const double done = (round + static_cast<double>(step) / schedule.stepsPerLevel) / rounds;
      if (!progress.report(Stage::field, span.from + (span.to - span.from) * done)) return cancelledError();
      NormalisedField after = normalised(timeStep.after(now.field), now.field);
      const double change = std::sqrt((after.field - now.field).squaredNorm() / static_cast<double>(level.size()));
      now = std::move(after);
      if (change < schedule.tolerance) break;
    }
  }
  return now;
}

}  // namespace qmcf
