#include "time_step.hpp"

namespace qmcf {
namespace {

/// Unknowns from which on conjugate gradients cost less than factors: the fill of these grows faster than the system.
constexpr Eigen::Index kIterativeSize = 20000;
constexpr int kMostIterations = 100;
constexpr double kReduction = 0.5;  // of the residual, per time step; repeated steps do the rest

/// x^H y of which only the real part is wanted, summed in order.
double realProduct(const FieldVector& x, const FieldVector& y) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) sum += x[i].real() * y[i].real() + x[i].imag() * y[i].imag();
  return sum;
}

}  // namespace

TimeStep::TimeStep(const Level& level, double time) : level_(level), time_(time) {
  if (level.size() < kIterativeSize) {
    FieldMatrix system = time * level.energy;
    for (Eigen::Index i = 0; i < level.size(); ++i) system.coeffRef(i, i) += level.cells[i];
    ok_ = factor_.emplace(system).info() == Eigen::Success;
    return;
  }
  diagonal_ = level.cells + time * level.energy.diagonal().real();
}

FieldVector TimeStep::after(const FieldVector& u) {
  const FieldVector side = level_.cells.cast<Complex>().cwiseProduct(u) + time_ * level_.side;
  if (factor_) return factor_->solve(side);
  if (last_.size() == 0) last_ = u;
  last_ = improved(side);
  return last_;
}

/// product = (cells + time * energy) x. The energy is Hermitian: a row is the conjugate of a column.
void TimeStep::apply(const FieldVector& x, FieldVector& product) const {
  const Complex* value = level_.energy.valuePtr();
  const auto* row = level_.energy.innerIndexPtr();
  const auto* begin = level_.energy.outerIndexPtr();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    double re = 0.0;
    double im = 0.0;
    for (auto k = begin[i]; k < begin[i + 1]; ++k) {
      const Complex a = value[k];
      const Complex b = x[row[k]];
      re += a.real() * b.real() + a.imag() * b.imag();
      im += a.real() * b.imag() - a.imag() * b.real();
    }
    product[i] = {level_.cells[i] * x[i].real() + time_ * re, level_.cells[i] * x[i].imag() + time_ * im};
  }
}

/// Conjugate gradients from last_, preconditioned by the diagonal.
FieldVector TimeStep::improved(const FieldVector& side) const {
  FieldVector x = last_;
  FieldVector product(x.size());
  apply(x, product);
  FieldVector residual = side - product;
  FieldVector scaled(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) scaled[i] = residual[i] / diagonal_[i];
  FieldVector direction = scaled;
  double square = realProduct(residual, scaled);
  const double enough = kReduction * kReduction * square;
  for (int iteration = 0; iteration < kMostIterations && square > enough; ++iteration) {
    apply(direction, product);
    const double step = square / realProduct(direction, product);
    double next = 0.0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      x[i] += step * direction[i];
      residual[i] -= step * product[i];
      scaled[i] = residual[i] / diagonal_[i];
      next += residual[i].real() * scaled[i].real() + residual[i].imag() * scaled[i].imag();
    }
    direction = scaled + (next / square) * direction;
    square = next;
  }
  return x;
}

}  // namespace qmcf
