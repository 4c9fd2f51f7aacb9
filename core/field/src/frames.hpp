#pragma once

#include "qmcf/field/connection.hpp"
#include "qmcf/field/cross_field.hpp"

namespace qmcf {

/// The frame of every vertex in which the connection's angles are, as nearly as possible, the directions of its
/// half-edges: at a boundary vertex the two boundary edges deviate alike, so that a smooth curve's tangent is x.
IdMap<VertexId, TangentFrame> tangentFrames(const Patch& patch, const Connection& connection);

/// Any unit vector orthogonal to the unit vector n.
Vec3 anyTangent(const Vec3& n);

/// The angle of a direction in a vertex's frame.
double angleIn(const TangentFrame& frame, const Vec3& direction);

/// The cross one of whose branches is the direction.
std::complex<double> crossAlong(const TangentFrame& frame, const Vec3& direction);

}  // namespace qmcf
