#pragma once

#include <cstddef>
#include <optional>

#include "prepare.hpp"
#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/pipeline/mesh_surface.hpp"

namespace qmcf {

/// Makes the sizes of the patch of a face on its edges what these were divided into, and lets them spread inwards from
/// there (spreadSizes(), E7 of docs/algorithm.md), not above the field's limits, nor above what the options ask for
/// inside faces. The part's own triangles stay as they are. What the sizes wanted until now would take goes into
/// prepared.wantedElements. Errors: those of spreadSizes().
std::optional<Error> spreadInside(PreparedFaces& prepared, std::size_t face, const RunOptions& options,
                                  Progress& progress);

/// Makes the sizes suit the crosses of the face, too (turnedSizes()), under the same bounds. Errors: its.
std::optional<Error> turnInside(PreparedFaces& prepared, std::size_t face, const RunOptions& options,
                                Progress& progress);

/// Makes the sizes what a mesh of the face came out with (sizesOfMesh()), under the same bounds. Errors: its.
std::optional<Error> followMesh(PreparedFaces& prepared, std::size_t face, const FaceMesh& mesh,
                                const RunOptions& options, Progress& progress);

/// About how many quads the sizes of the patch take, at least as many as its boundary needs.
double expectedElements(const Patch& patch);

}  // namespace qmcf
