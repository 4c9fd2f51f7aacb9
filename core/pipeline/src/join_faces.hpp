#pragma once

#include <vector>

#include "mesh_faces.hpp"
#include "part.hpp"
#include "prepare.hpp"
#include "qmcf/cleanup/joint_relaxation.hpp"
#include "shared_nodes.hpp"

namespace qmcf {

/// What is left out of the faces' relaxation.
struct Held {
  std::vector<char> faces;                ///< Per face: 1 if it stays as it is.
  std::vector<std::vector<Ball>> places;  ///< Per face: where it does.
};

/// Relaxes the faces' meshes together, across the edges that they share, and moves the nodes on these. Errors:
/// cancelled.
Result<std::int64_t> relaxJoint(const Part& part, const PreparedFaces& prepared, std::vector<SharedFace>& faces,
                                const Held& held, SharedNodes& shared, double sizeScale, Progress& progress);

/// Joins the faces' meshes at the nodes that they share. Faces without elements are left out.
QuadMesh joinFaces(const SharedNodes& shared, const std::vector<SharedFace>& faces);

}  // namespace qmcf
