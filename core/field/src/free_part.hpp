#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "solve.hpp"

namespace qmcf {

/// The factors L D L^H of a Hermitian matrix.
class FieldFactor : public Eigen::SimplicialLDLT<FieldMatrix, Eigen::Lower, Eigen::AMDOrdering<int>> {
 public:
  using SimplicialLDLT::SimplicialLDLT;

  /// Eigen's own solve() divides by D as complex numbers, which compilers' run-time libraries round differently.
  [[nodiscard]] FieldVector solve(const FieldVector& side) const {
    FieldVector x = permutationP() * side;
    matrixL().solveInPlace(x);
    const FieldVector diagonal = vectorD();
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] /= diagonal[i].real();
    matrixU().solveInPlace(x);
    return permutationPinv() * x;
  }
};

/// The unknowns of a system some of whose entries are given.
class FreePart {
 public:
  explicit FreePart(const std::vector<FieldPin>& pinned);

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(vertex_.size()); }
  [[nodiscard]] Eigen::Index vertex(Eigen::Index unknown) const { return vertex_[static_cast<std::size_t>(unknown)]; }
  /// Rows and columns of the unknowns.
  [[nodiscard]] FieldMatrix block(const FieldMatrix& matrix) const;
  /// Columns of the unknowns.
  [[nodiscard]] FieldMatrix columns(const FieldMatrix& matrix) const;
  /// Rows of the unknowns, of matrix times the given values.
  [[nodiscard]] FieldVector given(const FieldMatrix& matrix, const FieldVector& value) const;
  [[nodiscard]] FieldVector restrict(const FieldVector& all) const;
  void insert(const FieldVector& unknowns, FieldVector& all) const;

 private:
  std::vector<int> unknown_;          ///< Per vertex: number of its unknown, or kNone.
  std::vector<Eigen::Index> vertex_;  ///< Per unknown.
};

}  // namespace qmcf
