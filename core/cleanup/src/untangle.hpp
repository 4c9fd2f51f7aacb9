#pragma once

#include <cstdint>

#include "relaxation.hpp"

namespace qmcf {

/// Makes the two triangles beside a half-edge one quadrilateral.
FaceId joinTriangles(EditMesh& mesh, HalfedgeId h);

/// In creases and thin limbs an element can face against the surface although it is well shaped. Moves vertices of such
/// elements, over the face, to where fewer corners do, by trying places around them; never makes an element unusable.
/// What that doesn't turn back, changes of connectivity may: of pairs of triangles unless there shall be quadsOnly, and
/// of quads that stay quads if there shall, or if the check against the part is known, which is what finds the last
/// few. Returns how many elements were turned over before. Bounded: a few sweeps over those elements alone.
std::int64_t untangle(EditMesh& mesh, const RelaxationTarget& target, bool quadsOnly);

}  // namespace qmcf
