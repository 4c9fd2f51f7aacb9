#pragma once

#include "qmcf/front/front_mesh.hpp"

namespace qmcf {

/// Places 3 or 5 quads around a singularity of the cross field, turned so that their edges follow the field's
/// separatrices (section 4.2.1; D5). Returns false, with nothing changed, where there is no room: another front is
/// nearer than about one and a half elements.
bool placeStar(FrontMesh& front, const Singularity& singularity);

/// Places a single quad along the field in the middle of a patch that has neither boundary nor singularity.
bool placeSeed(FrontMesh& front, double place);

}  // namespace qmcf
