#pragma once

#include <cstdint>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/field/cross_field.hpp"
#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/mesh/trace.hpp"

namespace qmcf {

/// How the advancing front of one face works.
struct FrontOptions {
  bool patterns = true;      ///< Start with stars of 3 and 5 quads at the singularities (section 4.2.1).
  double fieldWeight = 0.8;  ///< Weight of the cross field against the front's own bisector, in [0, 1] (D2).
  double seedPlace = 0.0;    ///< Where a front starts that nothing else does, as a share of the triangles, in [0, 1).
  double snapRadius = 0.65;  ///< Existing front nodes this near, in element sizes, are used instead of a new point.
};

/// What happened in one face.
struct FrontStatistics {
  std::int64_t quads = 0;
  std::int64_t triangles = 0;   ///< Triangles left in the mesh.
  std::int64_t stars = 0;       ///< Patterns placed at singularities.
  std::int64_t rollbacks = 0;   ///< Attempts that were undone.
  std::int64_t collisions = 0;  ///< Quads that joined the front to itself or to another one.
  std::int64_t seams = 0;
  std::int64_t recombined = 0;  ///< Quads paired from triangles that the front left over.
};

struct FrontResult {
  FaceMesh mesh;
  FrontStatistics statistics;
};

/// Meshes one face with the cross-field driven advancing front (QMCF; sections 4.1 and 4.2 of the paper; Owen et al.
/// 1999): quads are formed from the front inwards on a working copy of the patch's triangulation, the ends of their
/// side edges placed by cross field and size field, their edges recovered by swaps. Each quad is a transaction. What
/// the front can't mesh is left as triangles, of which pairs become quads. The result is conforming, consistently
/// oriented and keeps the patch's boundary vertices. trace: who records the history, or nullptr. Errors: cancelled.
Result<FrontResult> advanceFront(const Patch& patch, const CrossField& field, const FrontOptions& options,
                                 Progress& progress, TraceRecorder* trace = nullptr);

/// The step of last resort: the patch's triangles, paired to quads where the pair is a good one.
FrontResult recombinePatch(const Patch& patch);

}  // namespace qmcf
