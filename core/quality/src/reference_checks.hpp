#pragma once

#include "checks.hpp"
#include "fidelity.hpp"
#include "reference.hpp"

namespace qmcf::quality {

/// Adds the checks that need a reference: "nonManifoldEdges", "nonManifoldVertices", "orientationConflicts" with what
/// the reference itself has allowed, "boundary", "cracks", "tJunctions", "components", "euler", "coverage",
/// "facesTurnedOver". size: the mesh's target length; projected: see projectCentres(), empty if there is no tree.
void addReferenceChecks(const MeasuredMesh& measured, const Reference& reference, double size,
                        const std::vector<ClosestPoint>& projected, CheckList& checks);

}  // namespace qmcf::quality
