#pragma once

#include <optional>

#include "level.hpp"

namespace qmcf {

/// Solves (cells + time * energy) x = cells u + time * side over and over for different u.
class TimeStep {
 public:
  TimeStep(const Level& level, double time);

  /// False if the system could not be factorised.
  [[nodiscard]] bool ok() const { return ok_; }
  /// The unnormalised crosses one time step after u. Large systems are solved by conjugate gradients that begin with
  /// the last result, to a residual small against the change since then: repeated steps converge with it.
  [[nodiscard]] FieldVector after(const FieldVector& u);

 private:
  [[nodiscard]] FieldVector improved(const FieldVector& side) const;
  void apply(const FieldVector& x, FieldVector& product) const;

  const Level& level_;
  double time_;
  bool ok_ = true;
  std::optional<FieldFactor> factor_;  ///< Of small systems.
  Eigen::VectorXd diagonal_;           ///< Of large ones.
  FieldVector last_;
};

}  // namespace qmcf
