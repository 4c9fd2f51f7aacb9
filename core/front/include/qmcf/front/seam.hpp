#pragma once

#include "qmcf/front/front_mesh.hpp"

namespace qmcf {

/// Closes a narrow wedge of the front at origin(h) by merging the far ends of its two front edges (Owen et al. 1999).
/// Returns the vertex that remains of the two, or an invalid id, with nothing changed, when both are fixed, differ too much
/// in length, or an element would become worse than `least`.
VertexId closeSeam(FrontMesh& front, HalfedgeId h, double least);

}  // namespace qmcf
