#pragma once

#include <cstdint>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/mesh/trace.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"

namespace qmcf {

/// Length of the triangles' edges, in units of the element size, that Q-Morph expects of its triangulation: it merges
/// triangles of the size that its quads shall have.
inline constexpr double kMorphTriangleSize = 1.13;

/// How the original advancing front of one face works. Angles in radians.
struct MorphOptions {
  double sideAngle = 0.5235987755982988;  ///< An edge this near to the bisector serves as a side edge (pi/6).
  double busySeam = 0.1256637061435917;   ///< Front angle that is closed by a seam where five quads or more meet.
  double seam = 0.7;                      ///< The same where fewer quads meet.
  double largestRatio = 2.5;              ///< Neighbouring front edges that differ more in length need a transition.
};

/// What happened in one face.
struct MorphStatistics {
  std::int64_t quads = 0;
  std::int64_t triangles = 0;   ///< Triangles left in the mesh.
  std::int64_t existing = 0;    ///< Side edges that the triangulation had.
  std::int64_t swaps = 0;       ///< Side edges made by swapping an edge.
  std::int64_t splits = 0;      ///< Side edges made by splitting an edge.
  std::int64_t collisions = 0;  ///< Quads that joined the front to itself or to another one.
  std::int64_t seams = 0;
  std::int64_t transitions = 0;  ///< Transition seams and transition splits.
  std::int64_t rollbacks = 0;    ///< Attempts that were undone.
  std::int64_t recombined = 0;   ///< Quads paired from triangles that the front left over.
};

struct MorphResult {
  FaceMesh mesh;
  MorphStatistics statistics;
};

/// Meshes one face with the original Q-Morph (Owen, Staten, Canann, Saigal 1999; section 4.1 of the paper): triangles
/// of the element's size are merged to quads from the front inwards, side edges are taken from the triangulation or
/// made by a swap or a split near the bisector of the front's angle, top edges are recovered by swaps, and nodes are
/// smoothed after each quad. The cross field is not asked, nor are sizes but for transitions. Each quad is a
/// transaction. What the front can't mesh is left as triangles, of which pairs become quads. The result is conforming,
/// consistently oriented and keeps the patch's boundary vertices. face: the tree over the face's input triangles, on
/// which moved nodes are put. trace: who records the history, or nullptr. Errors: cancelled.
Result<MorphResult> advanceMorph(const Patch& patch, const TriangleBvh& face, const MorphOptions& options,
                                 Progress& progress, TraceRecorder* trace = nullptr);

}  // namespace qmcf
