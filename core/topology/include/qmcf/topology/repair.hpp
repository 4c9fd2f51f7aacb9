#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"

namespace qmcf {

/// One kind of defect, what was done about it and where.
struct RepairItem {
  std::string defect;                  ///< Identifier, e.g. "duplicateVertices", "degenerateTriangles".
  std::string action;                  ///< What was done, for a person: "merged", "removed", "turned round".
  std::int64_t count = 0;
  std::vector<std::int64_t> elements;  ///< Ids in the input mesh, at most 100.
};

struct RepairOptions {
  bool modify = true;  ///< false: report the defects and change nothing but what can't be represented.
};

/// A mesh that the later stages can work on, and how it differs from what was read.
struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<std::int64_t> triangleOrigin;  ///< Per triangle: triangle of the input.
  std::vector<RepairItem> items;             ///< In the order in which they were done.
};

/// Makes any triangle soup usable: exact weld, degenerate and duplicate triangles removed, orientation made consistent
/// across two-sided edges of each component and outward for closed ones, unreferenced vertices dropped.
/// Non-manifold edges and vertices stay; recoverBrep() cuts there.
/// Errors: noSurface, nonFiniteCoordinate, indexOutOfRange, cancelled.
Result<RepairedMesh> repair(const TriangleMesh& input, const RepairOptions& options, Progress& progress);

}  // namespace qmcf
