#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"

namespace qmcf {

/// One kind of defect, what was done about it and where.
struct RepairItem {
  std::string defect;  ///< Identifier, e.g. "duplicateVertices", "degenerateTriangles".
  std::string action;  ///< What was done, for a person: "merged", "removed", "turned round".
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
  /// Edges, by their vertices, along which a triangle was removed that was too flat to have a normal.
  std::vector<std::array<std::int32_t, 2>> flatEdges;
};

/// Makes any triangle soup usable. In this order, with the identifiers of the items it reports:
///
/// - exact weld, 0 equal to -0: duplicateVertices, or unsharedVertices for formats that store each triangle by itself;
/// - triangles with a repeated corner removed: degenerateTriangles;
/// - of triangles on the same vertices one kept: duplicateTriangles; of opposite ones, zeroThicknessSheets, while those
///   that hang on a closed surface go: zeroThicknessFins;
/// - triangles without area removed such that no crack opens: zeroAreaTriangles;
/// - boundary vertices within the tolerance merged: nearlyEqualVertices; boundary edges split at boundary vertices that
///   lie on them: tJunctions. Tolerance: 1e-6 of the bounding box' diagonal, but at most a tenth of the
///   median of the triangles' longest sides, or 4 units of the last place of coordinates in single precision when these
///   are larger;
/// - triangles lower than the tolerance removed likewise: sliverTriangles;
/// - orientation made consistent across two-sided edges: misorientedTriangles. Where that was needed, closed components
///   that are not the wall of a cavity are turned outwards, elsewhere they are reported only: inwardShells; where a
///   piece has one side only, it stays inconsistent along a cut: oneSidedEdges;
/// - a non-manifold edge that a sheet meets in its middle halved: loneNonManifoldEdges;
/// - edges with more than two triangles and vertices where sheets touch in a point counted: nonManifoldEdges,
///   nonManifoldVertices. They stay; recoverBrep() cuts there;
/// - vertices without triangles dropped: unusedVertices for those of the input.
///
/// Ids of items are vertices for defects of vertices and T-junctions, else triangles. With options.modify false, only
/// exact welding, removal of repeated corners and halving change the mesh; the rest is counted. Errors: noSurface (also
/// when the model is less than 1e-60 across), nonFiniteCoordinate (also beyond 1e150), indexOutOfRange, tooLarge,
/// cancelled.
Result<RepairedMesh> repair(const TriangleMesh& input, const RepairOptions& options, Progress& progress);

}  // namespace qmcf
