#pragma once

#include "qmcf/field/connection.hpp"
#include "qmcf/field/cross_field.hpp"

namespace qmcf {

/// arg of u at h's target against u of its origin moved there, in (-pi, pi]; the negative for the twin.
double crossTurn(const Surface& surface, const Connection& connection,
                 const IdMap<VertexId, std::complex<double>>& cross, HalfedgeId h);

/// Quarter turns of the field around a triangle (A6 of docs/algorithm.md).
std::int32_t triangleIndex(const Surface& surface, const Connection& connection,
                           const IdMap<VertexId, std::complex<double>>& cross, TriangleId t);

/// The same of every triangle.
IdMap<TriangleId, std::int32_t> triangleIndices(const Surface& surface, const Connection& connection,
                                                const IdMap<VertexId, std::complex<double>>& cross);

/// Where the mean of three crosses vanishes; the centre when it does nowhere.
std::array<double, 3> zeroOf(const std::array<std::complex<double>, 3>& corner);

/// All triangles of non-zero index with their zeros, by triangle.
std::vector<Singularity> locateSingularities(const CrossField& field);

}  // namespace qmcf
