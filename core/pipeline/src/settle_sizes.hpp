#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "prepare.hpp"
#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/pipeline/mesh_surface.hpp"

namespace qmcf {

/// Gives the patches of these faces the sizes inside that suit their edges and crosses (settledSizes(), E7 of
/// docs/algorithm.md), not above the field's limits, nor above what the options ask for inside faces. The part's own
/// triangles stay as they are. What the sizes wanted until now would take goes into prepared.wantedElements.
/// faces: ascending. Errors: those of settledSizes().
std::optional<Error> settleSizes(PreparedFaces& prepared, const std::vector<std::int32_t>& faces,
                                 const MeshOptions& options, Progress& progress);

/// About how many quads the sizes of the patch take.
double expectedElements(const Patch& patch);

}  // namespace qmcf
