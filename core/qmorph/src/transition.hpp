#pragma once

#include <vector>

#include "morph_mesh.hpp"

namespace qmcf {

/// Closes a narrow angle of the front at origin(h) between two front edges of very different length (transition seam,
/// Owen et al. 1999): the longer one is halved, its quad cut to a quad and a triangle, and the triangle, with what lies
/// between the two front edges, becomes a new quad with the shorter one as a side. Returns the corners of the new quad,
/// none and nothing changed when there is no quad behind the longer edge, it is short itself, or an element would
/// become worse than `least`.
std::vector<VertexId> transitionSeam(MorphMesh& morph, HalfedgeId h, double least);

/// Passes from a long front edge to a short one at origin(h) (transition split, Owen et al. 1999): the quad behind the
/// longer one becomes two quads and a triangle, which is given back to the open region. Returns the new front edge
/// whose two sides are there, invalid and nothing changed when there is no quad behind the longer edge, it is short
/// itself, or an element would become worse than `least`.
HalfedgeId transitionSplit(MorphMesh& morph, HalfedgeId h, double least);

}  // namespace qmcf
