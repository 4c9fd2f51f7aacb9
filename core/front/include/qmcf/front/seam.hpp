#pragma once

#include <vector>

#include "qmcf/front/front_mesh.hpp"

namespace qmcf {

/// Closes a narrow wedge of the front at origin(h) by merging the far ends of its two front edges (Owen et al. 1999).
/// Returns the vertex that remains of the two, or an invalid id, with nothing changed, when both are fixed, differ too
/// much in length, or an element would become worse than `least`.
VertexId closeSeam(FrontMesh& front, HalfedgeId h, double least);

/// Closes a front loop of four edges by merging two opposite corners, where no good quad fits in. corners: its
/// vertices, in order. Returns the vertex that remains of the two, or an invalid id, with nothing changed, when an
/// element would become worse than `least` either way.
VertexId closeDiamond(FrontMesh& front, const std::vector<VertexId>& corners, double least);

}  // namespace qmcf
