#pragma once

#include <vector>

#include "prepare.hpp"
#include "qmcf/mesh/quad_mesh.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/pipeline/mesh_surface.hpp"

namespace qmcf {

/// The edges of `mesh` against the sizes of the faces' patches, divided by `coarsening`. An edge between two faces is
/// measured once, in the first element that has it. asked: the sizes to measure by where the patches were made with
/// others, or null; `repaired` is what both fields are of.
SizeConformity sizeConformity(const QuadMesh& mesh, const TriangleMesh& repaired, const PreparedFaces& prepared,
                              const SizeField* asked, double coarsening);

/// The target length at each vertex of the input, divided by `coarsening`: the field's value at the closest point of
/// the repaired mesh, linear in its triangles. \pre repaired has a triangle
std::vector<double> sizesAt(const std::vector<Vec3>& points, const TriangleMesh& repaired, const SizeField& size,
                            double coarsening);

/// The same where sizes are settled: those of the closest patch. asked: as in sizeConformity().
std::vector<double> settledSizesAt(const std::vector<Vec3>& points, const TriangleMesh& repaired,
                                   const PreparedFaces& prepared, const SizeField* asked, double coarsening);

/// All sizes that sizeConformity() measures by. asked, coarsening: as there.
SizingMesh sizingMeshOf(const TriangleMesh& repaired, const PreparedFaces& prepared, const SizeField* asked,
                        double coarsening);

}  // namespace qmcf
