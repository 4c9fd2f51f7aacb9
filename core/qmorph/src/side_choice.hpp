#pragma once

#include <vector>

#include "morph_mesh.hpp"
#include "qmcf/qmorph/qmorph.hpp"

namespace qmcf {

/// A way of getting a side edge at a front node.
struct SideChoice {
  enum class Kind : std::uint8_t {
    existing,  ///< edge is the side edge, leaving the node.
    swap,      ///< The side edge is what edge becomes when it is swapped.
    split,     ///< The side edge runs to a new node on edge.
  };
  Kind kind = Kind::existing;
  HalfedgeId edge;
  VertexId end;             ///< The far node; invalid for a split.
  EditMesh::Vertex vertex;  ///< The new node of a split.
};

/// The ways of getting a side edge at the origin of the front edge `sector` (step 4a; Owen et al. 1999): first the one
/// that Q-Morph takes, which is the existing edge nearest to the bisector of the front's angle if it is near enough,
/// else the swapped edge that is, else an edge to a new node where the bisector leaves its triangle; then the others,
/// for a front that got stuck. No way ends at `forbidden`. Empty when front edges are in the way.
std::vector<SideChoice> sideChoices(const MorphMesh& morph, HalfedgeId sector, VertexId forbidden,
                                    const MorphOptions& options);

/// Makes the side edge; returns its far node.
VertexId realize(MorphMesh& morph, const SideChoice& choice);

}  // namespace qmcf
