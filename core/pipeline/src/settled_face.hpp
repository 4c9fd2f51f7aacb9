#pragma once

#include "mesh_faces.hpp"
#include "part.hpp"
#include "prepare.hpp"
#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"

namespace qmcf {

/// Whether sizes settle with the meshes: the options let sizes settle at all, and the elements are not so many that
/// the meshes are near enough to the sizes by themselves.
bool settlesWithMeshes(const Part& part, const PreparedFaces& prepared);

/// Meshes a face by meshFace(), then once more with the sizes of its patch as that mesh came out (followMesh(), E7 of
/// docs/algorithm.md). The second mesh is kept if it is nearer to its sizes than the first was to its own and hardly
/// less regular; otherwise the first one and the sizes before. Where the first is near enough, or not made by the
/// front, or where sizes can't be computed from it, it stays. Errors: cancelled.
Result<MeshedFace> meshSettled(const Part& part, PreparedFaces& prepared, std::int32_t face, Progress& progress);

}  // namespace qmcf
