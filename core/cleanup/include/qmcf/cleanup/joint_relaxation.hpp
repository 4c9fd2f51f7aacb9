#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/sizing/edge_curve.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"

namespace qmcf {

/// All points within a distance of one.
struct Ball {
  Vec3 centre;
  double radius = 0.0;
};

/// The mesh of one face, to be relaxed together with its neighbours.
struct JointFace {
  FaceMesh* mesh = nullptr;                         ///< In and out; without elements it takes no part.
  const std::vector<std::int32_t>* node = nullptr;  ///< Per vertex of the mesh: the node that it shares; kNone inside.
  const Patch* patch = nullptr;
  const TriangleBvh* target = nullptr;  ///< The face's input triangles.
  bool held = false;                    ///< Stays as it is, with the nodes on its edges.
  std::vector<Ball> heldPlaces{};       ///< Only what is in these does.
};

/// The nodes along one edge of the B-rep.
struct JointEdge {
  EdgeCurve curve;
  std::vector<std::int32_t> nodes;  ///< From start to end; closed: first == last.
  std::vector<double> arcLength;    ///< Per entry, ascending from 0 to the length.
  bool slidesAtStart = false;       ///< The edge is closed, and the vertex that closes it may slide, too.
  std::vector<double> stays{};      ///< Arc lengths, ascending: a node exactly there does not slide.
};

struct JointRelaxationOptions {
  double sizeScale = 1.0;  ///< Element length in units of the patches' sizes, > 0.
  int rounds = 6;          ///< Of nodes and what is near them, 0 to 50; 0: only the worst elements are seen to.
};

/// Relaxes the meshes of all faces together: nodes slide along their edges to where the elements of all faces around
/// want them, and the vertices near them follow on their faces. No element becomes worse than it was and than
/// relax() tolerates; no chord departs further from its edge than before or than a twentieth of the element size; no
/// division becomes shorter than half of what it was. In the end what is around an element with a shape below 0.6 moves
/// to where the worst element is best. nodes: positions of the shared nodes, in and out. Returns how many nodes moved
/// by more than a tenth of the element size. Errors: cancelled.
Result<std::int64_t> relaxTogether(std::vector<JointFace>& faces, const std::vector<JointEdge>& edges,
                                   std::vector<Vec3>& nodes, const JointRelaxationOptions& options, Progress& progress);

}  // namespace qmcf
