#include "free_part.hpp"

namespace qmcf {

FreePart::FreePart(const std::vector<FieldPin>& pinned) : unknown_(pinned.size(), kNone) {
  for (std::size_t v = 0; v < pinned.size(); ++v) {
    if (pinned[v] != FieldPin::none) continue;
    unknown_[v] = static_cast<int>(vertex_.size());
    vertex_.push_back(static_cast<Eigen::Index>(v));
  }
}

FieldMatrix FreePart::block(const FieldMatrix& matrix) const {
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(static_cast<std::size_t>(matrix.nonZeros()));
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
    const int to = unknown_[static_cast<std::size_t>(column)];
    if (to < 0) continue;
    for (FieldMatrix::InnerIterator it(matrix, column); it; ++it) {
      const int from = unknown_[static_cast<std::size_t>(it.row())];
      if (from >= 0) entries.emplace_back(from, to, it.value());
    }
  }
  FieldMatrix result(size(), size());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

FieldMatrix FreePart::columns(const FieldMatrix& matrix) const {
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(static_cast<std::size_t>(matrix.nonZeros()));
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
    const int to = unknown_[static_cast<std::size_t>(column)];
    if (to < 0) continue;
    for (FieldMatrix::InnerIterator it(matrix, column); it; ++it) {
      entries.emplace_back(static_cast<int>(it.row()), to, it.value());
    }
  }
  FieldMatrix result(matrix.rows(), size());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

FieldVector FreePart::given(const FieldMatrix& matrix, const FieldVector& value) const {
  FieldVector result = FieldVector::Zero(size());
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
    if (unknown_[static_cast<std::size_t>(column)] >= 0) continue;
    for (FieldMatrix::InnerIterator it(matrix, column); it; ++it) {
      const int from = unknown_[static_cast<std::size_t>(it.row())];
      if (from >= 0) result[from] += it.value() * value[column];
    }
  }
  return result;
}

FieldVector FreePart::restrict(const FieldVector& all) const {
  FieldVector result(size());
  for (Eigen::Index i = 0; i < size(); ++i) result[i] = all[vertex(i)];
  return result;
}

void FreePart::insert(const FieldVector& unknowns, FieldVector& all) const {
  for (Eigen::Index i = 0; i < size(); ++i) all[vertex(i)] = unknowns[i];
}

}  // namespace qmcf
