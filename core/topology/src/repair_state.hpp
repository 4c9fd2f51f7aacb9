#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/topology/repair.hpp"

namespace qmcf::detail {

/// The mesh while it is being repaired. Vertices keep the ids of the input until the last pass; new ones are appended.
struct RepairState {
  TriangleMesh mesh;
  std::vector<std::int64_t> origin;  ///< Per triangle: triangle of the input.
  std::vector<RepairItem> items;
  std::vector<std::array<std::int32_t, 2>> flatEdges;  ///< As in RepairedMesh; they may be gone meanwhile.
  bool modify = true;
  double diagonal = 0.0;   ///< Of the bounding box of the triangles.
  double precision = 0.0;  ///< Distance below which two points can't be told apart.
  double tolerance = 0.0;  ///< Distance below which two points were meant to be the same.
};

/// Counts one defect of the input and keeps the first ids.
void note(RepairItem& item, std::int64_t id);
/// Adds the item unless nothing was found; a second item of the same kind is added to the first.
void addItem(RepairState& state, RepairItem item);
/// Drops the triangles whose flag is 0.
void keepTriangles(RepairState& state, const std::vector<std::uint8_t>& keep);

// The passes, one per file unless tiny, in the order in which repair() runs them.

/// Merges vertices with equal coordinates (0 equals -0) and drops triangles that lose a corner by it.
void weldExact(RepairState& state);
/// Drops triangles with a repeated corner.
void removeRepeatedCorners(RepairState& state);
/// Of triangles with the same three vertices keeps one; see duplicates.cpp for folded pairs.
void removeDuplicates(RepairState& state);
/// Removes triangles without area (lower than the precision) such that no crack opens.
void removeZeroArea(RepairState& state);
/// Joins boundaries that are closer than the tolerance: merges vertices, splits edges at T-junctions.
void closeGaps(RepairState& state);
/// Removes triangles lower than the tolerance likewise, where the surface stays what it is.
void removeSlivers(RepairState& state);
/// Makes the orientation consistent across two-sided edges, outward where there is an inside.
void orient(RepairState& state);
/// Splits single non-manifold edges in the middle of a sheet, which can't be cut open without a further vertex.
void splitLoneEdges(RepairState& state);
/// Counts edges with more than two triangles, and vertices whose triangles form several fans: they stay.
void noteNonManifold(RepairState& state);
/// Counts the vertices of the input that no triangle uses.
void noteUnusedVertices(RepairState& state);
/// Drops vertices that no triangle uses and renumbers the others in their order.
void dropUnreferenced(RepairState& state);

}  // namespace qmcf::detail
