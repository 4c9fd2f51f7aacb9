#pragma once

#include <optional>

#include "checks.hpp"
#include "fidelity.hpp"
#include "reference.hpp"

namespace qmcf::quality {

/// Four times the Euler characteristic of the reference's sheets (see IndexLedger), if it can be told.
std::optional<std::int64_t> fourEulerOf(const Reference& reference);

/// Adds the checks that need a reference: "nonManifoldEdges", "nonManifoldVertices", "orientationConflicts" with what
/// the reference itself has allowed, "boundary", "cracks", "tJunctions", "components", "euler", "indexLedger",
/// "coverage", "facesTurnedOver". report: has the mesh's target length and its ledger; projected: see projectCentres(),
/// empty if there is no tree.
void addReferenceChecks(const MeasuredMesh& measured, const Reference& reference, const QualityReport& report,
                        const std::vector<ClosestPoint>& projected, CheckList& checks);

}  // namespace qmcf::quality
