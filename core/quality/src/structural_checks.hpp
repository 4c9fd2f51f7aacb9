#pragma once

#include "checks.hpp"
#include "qmcf/mesh/quad_mesh.hpp"
#include "screening.hpp"
#include "structure.hpp"

namespace qmcf::quality {

/// Adds the checks of elements and vertices by themselves: "empty", "indexOutOfRange", "nonFiniteCoordinate",
/// "repeatedCorner", "duplicateElements", "unreferencedVertices", "invertedElements".
void addElementChecks(const QuadMesh& mesh, const Screening& screening, CheckList& checks);

/// Adds "featureSegments": every segment that says it is an edge of the mesh has to be one.
void addSegmentCheck(const QuadMesh& mesh, const Structure& structure, CheckList& checks);

/// Adds "nonManifoldEdges", "nonManifoldVertices" and "orientationConflicts" with the feature segments as the only
/// places where such things may be.
void addManifoldChecks(const QuadMesh& mesh, const Structure& structure, CheckList& checks);

/// Vertices with more than one fan of elements.
std::vector<std::int64_t> pinchedVertices(const Structure& structure);
/// First elements of the edges whose two elements run along them in the same direction.
std::vector<std::int64_t> orientationConflicts(const Structure& structure);
/// First elements of the edges with more than two elements.
std::vector<std::int64_t> nonManifoldEdges(const Structure& structure);

}  // namespace qmcf::quality
