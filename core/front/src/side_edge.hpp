#pragma once

#include <optional>
#include <vector>

#include "qmcf/front/advancing_front.hpp"
#include "qmcf/front/front_mesh.hpp"

namespace qmcf {

/// Where the far end of a side edge could be.
struct SideProposal {
  VertexId existing;        ///< A front node, or invalid for a new point.
  EditMesh::Vertex vertex;  ///< The new point.
  double cost = 0.0;        ///< How far from the ideal, in element sizes; small is good.
};

/// What a side edge is asked for.
struct SideRequest {
  HalfedgeId sector;            ///< Front edge whose origin the side edge leaves.
  int quads = 2;                ///< Number of quads that the sector should get, >= 2.
  bool left = true;             ///< Side edge of the base that starts the sector; false: of the one that ends it.
  std::optional<Vec3> closure;  ///< Where the quad would be a parallelogram (D2), if that is known.
  bool lastResort = false;      ///< Offer a new point also where front nodes are so near that they should be used.
};

/// Possible ends of a side edge, best first (sections 4.2 (2) and (3) of the paper): the point found by following cross
/// field and size field from the front node, with its length adjusted so that a gap to an opposite front closes in
/// whole elements, and front nodes close to it.
std::vector<SideProposal> proposeSide(const FrontMesh& front, const SideRequest& request, const FrontOptions& options);

}  // namespace qmcf
