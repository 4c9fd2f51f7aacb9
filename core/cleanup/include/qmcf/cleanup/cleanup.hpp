#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/mesh/trace.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"

namespace qmcf {

/// The part that a face belongs to.
struct WholePart {
  const TriangleBvh& tree;                      ///< Over all its triangles.
  const std::vector<std::int32_t>& triangleOf;  ///< Per triangle of the face: which of the part's it is.
};

/// Improvement of the mesh of one face.
struct CleanupOptions {
  bool quadsOnly = false;    ///< Make no triangle where there was none.
  double sizeScale = 1.0;    ///< Element length in units of the patch's sizes, > 0.
  bool topology = true;      ///< Change connectivity where that makes vertices more regular.
  bool pairAll = false;      ///< Make quads of all triangles, in pairs, as long as solvers take them.
  std::int32_t rounds = 6;   ///< Rounds of topological operators and relaxation, 0 to 50.
  std::int32_t sweeps = 25;  ///< Relaxation sweeps over all vertices at the end, 0 to 200.
  double leastShape = 0.2;   ///< No operator may leave an element with a smaller scaled Jacobian, in (0, 1).
  /// Elements that the check against the part would find turned over are mended. nullptr: it is left to the check to
  /// find them.
  const WholePart* part = nullptr;
};

/// What was done.
struct CleanupStatistics {
  std::int64_t doublets = 0;    ///< Interior vertices with two elements that were removed.
  std::int64_t refills = 0;     ///< Small cavities that were filled anew.
  std::int64_t cavities = 0;    ///< Larger ones that were filled with a pattern.
  std::int64_t collapses = 0;   ///< Quads that were closed along a diagonal.
  std::int64_t pairs = 0;       ///< Pairs of triangles that operators made quads.
  std::int64_t turnedOver = 0;  ///< Elements facing against the surface whose vertices were moved.
  std::int64_t cuts = 0;        ///< Quads turned over at a corner that were cut into two good triangles.
  std::int64_t joins = 0;       ///< Pairs of triangles that became good quads in the end.
};

struct CleanupResult {
  FaceMesh mesh;
  CleanupStatistics statistics;
  double worstShape = 1.0;               ///< Smallest quadShape() or triangleShape().
  std::vector<std::int32_t> degenerate;  ///< Elements of the mesh that no solver takes; none in a valid mesh.
  std::vector<std::int32_t> before;      ///< Per vertex: the one of the mesh given that it was, or kNone.
};

/// Makes a quad-dominant mesh of one face more regular and its elements squarer. Boundary vertices keep their places,
/// all others stay on the face, given by `target`, the tree over the face's input triangles (D9, C7 of
/// docs/algorithm.md). Every change is undone that makes the mesh worse. trace: who records the
/// history, or nullptr; start: what the mesh is that the clean-up begins with. Errors: cancelled.
Result<CleanupResult> cleanUp(const FaceMesh& mesh, const Patch& patch, const TriangleBvh& target,
                              const CleanupOptions& options, Progress& progress, TraceRecorder* trace = nullptr,
                              TraceKind start = TraceKind::cleanup);

}  // namespace qmcf
