#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/sizing/divide.hpp"
#include "qmcf/sizing/size_field.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {

struct BackgroundOptions {
  double relativeSize = 0.8;  ///< Length of the triangles' edges in units of the size field, in [0.3, 2].
  /// The same where the face is flat and its edges are far away; at least relativeSize.
  double flatSize = 1.7;
  std::int32_t iterations = 5;  ///< Rounds of split, collapse, flip, smooth, project; 1 to 50.
};

/// The clean triangulation of one face, or the edges that need more divisions before there can be one.
struct BackgroundResult {
  Patch patch;                          ///< Its boundary edges are exactly the divisions of the face's edges.
  std::vector<std::int32_t> tooCoarse;  ///< Edges of the B-rep whose chords cut through the face; then patch is empty.
  std::vector<SizeLimit> missed;  ///< Where the size is too large for the patch to follow the face, with a better one.
};

/// Remeshes one face isotropically to the size field with its boundary given by the divided edges: the boundary of the
/// patch consists of exactly the division nodes, each interior vertex lies on the face's input triangles.
/// Botsch and Kobbelt 2004. Bounded by options.iterations. Errors: cancelled, internal.
Result<BackgroundResult> buildBackground(const TriangleMesh& mesh, const Brep& brep, std::int32_t face,
                                         const SizeField& size, const DividedEdges& divided,
                                         const BackgroundOptions& options, Progress& progress);

/// The face's own triangles as its patch, however long and thin they are: it follows the face exactly.
/// \pre the face's edges are divided at their own points (asGiven of divideEdges())
Patch givenTriangles(const Brep& brep, std::int32_t face, const SizeField& size, const DividedEdges& divided);

}  // namespace qmcf
