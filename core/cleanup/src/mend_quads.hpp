#pragma once

#include "qmcf/mesh/edit_mesh.hpp"
#include "relaxation.hpp"

namespace qmcf {

/// Changes the connectivity around quadrilaterals that are turned over: closes them along a diagonal, or fills them and
/// their neighbours with quadrilaterals in another way, whichever leaves fewest elements turned over once the vertices
/// there have been moved. Makes no triangles. Returns whether any change helped.
bool mendQuads(EditMesh& mesh, const RelaxationTarget& target);

}  // namespace qmcf
