#pragma once

#include <optional>

#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/mesh/patch.hpp"

namespace qmcf {

/// Meshes a narrow face without vertices inside: the best way to join the nodes of its boundary by quadrilaterals and,
/// where there is no other way, triangles: that of the least shapeCost(). Nothing where the face is wider than an
/// element on the whole, where it has handles, or where no such mesh has well-shaped elements everywhere.
///
/// The loops are joined to one polygon along the shortest ways between them; the polygon is cut by dynamic programming
/// over its short chords (D13 of docs/algorithm.md). A front can't do that: it places an element by what is near, and
/// where the two sides run out of step it has no room for anything but triangles.
/// Complexity O(n c^3) for n nodes with c chords each, after O(n^2) to find these.
std::optional<FaceMesh> meshStrip(const Patch& patch);

}  // namespace qmcf
