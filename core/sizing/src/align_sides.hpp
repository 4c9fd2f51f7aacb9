#pragma once

#include <vector>

#include "edge_plan.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// Moves the nodes of faces of one row across from each other (E3 of docs/algorithm.md): places across from the ends of
/// one side's edges are sought by the nodes of the other, then places across from all its nodes by those of the first.
/// Faces in a row; what an edge sought for one face it keeps for the next. places: per edge, the arc lengths of its
/// nodes, which are changed; plans get what is sought.
void alignSides(const Brep& brep, std::vector<EdgePlan>& plans, std::vector<std::vector<double>>& places);

/// Gives both sides of a slit as many divisions as the side that needs more, where they are of equal length and hardly
/// apart in the middle.
void levelSlits(const TriangleMesh& mesh, const Brep& brep, std::vector<EdgePlan>& plans);

/// Moves nodes of one side of a slit across from those of the other, where it is no wider than slitWidth(). places and
/// plans: as for alignSides().
void alignSlits(const TriangleMesh& mesh, const Brep& brep, std::vector<EdgePlan>& plans,
                std::vector<std::vector<double>>& places);

}  // namespace qmcf
