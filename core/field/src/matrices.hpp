#pragma once

#include <Eigen/SparseCore>
#include <complex>

#include "qmcf/field/connection.hpp"
#include "qmcf/mesh/patch.hpp"

namespace qmcf {

using Complex = std::complex<double>;
using FieldMatrix = Eigen::SparseMatrix<Complex>;
using FieldVector = Eigen::VectorXcd;

/// The discrete Dirichlet energy u^H energy u of cross fields, and the measures that go with it.
struct FieldMatrices {
  FieldMatrix energy;     ///< Hermitian, positive semi-definite.
  FieldMatrix mass;       ///< Hermitian; diagonal for the connection Laplacian.
  Eigen::VectorXd area;   ///< Per vertex: a third of the triangles around it.
  Eigen::VectorXd cells;  ///< The same area in units of the elements wanted there.
};

/// Areas and cells of the vertices; energy and mass empty.
FieldMatrices measuredMatrices(const Patch& patch);

/// The connection Laplacian with cotangent weights (A3 of docs/algorithm.md).
FieldMatrices assembleCotangent(const Patch& patch, const Connection& connection);

/// The full finite-element matrices (A2). smoothness: s in [-1, 1] between antiholomorphic and holomorphic energy, 0
/// for Dirichlet's.
FieldMatrices assembleFiniteElements(const Patch& patch, const Connection& connection, double smoothness);

}  // namespace qmcf
