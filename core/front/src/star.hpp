#pragma once

#include "qmcf/front/front_mesh.hpp"

namespace qmcf {

/// Places 3 to 6 quads, as many as its index asks for, around a singularity of the cross field, turned so that their
/// edges follow the field's separatrices (section 4.2.1; D5). Returns false, with nothing changed, where there is no
/// room: another front is nearer than 2.2 elements.
bool placeStar(FrontMesh& front, const Singularity& singularity);

/// Places a single quad along the field in a patch that has neither boundary nor singularity. place: in [0, 1), where
/// in the list of the patch's triangles.
bool placeSeed(FrontMesh& front, double place);

}  // namespace qmcf
