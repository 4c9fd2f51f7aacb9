#pragma once

#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/field/cross_field.hpp"
#include "qmcf/mesh/patch.hpp"

namespace qmcf {

/// Streamlines of a cross field at even distances, for pictures (after Jobard and Lefer 1997, with two families of
/// lines that may cross). From vertex after vertex a line is followed both ways along each of the two axes of the cross
/// there, until it leaves the patch, meets a singularity, or comes nearer than half the spacing to a line that runs its
/// way, itself included. A line is not begun nearer than the spacing to such a line. spacing: in units of the model, >
/// 0. At least one line results unless the field has no confidence at any vertex. Returns polylines of two points or
/// more. Complexity: linear in the number of triangles and in area / spacing^2.
std::vector<std::vector<Vec3>> evenStreamlines(const Patch& patch, const CrossField& field, double spacing);

}  // namespace qmcf
