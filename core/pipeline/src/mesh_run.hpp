#pragma once

#include "qmcf/pipeline/mesh_surface.hpp"

namespace qmcf {

/// Meshes an inspected part; as long as the mesh is not valid and smaller elements may help, once more with these (H8
/// of docs/algorithm.md). input: the mesh that was inspected; options: valid, with a size, a number of elements or
/// sizes, these at the vertices of the repaired mesh.
/// sizing: gets the sizes that the mesh was made with, unless nullptr. Errors: cancelled, noSurface.
Result<MeshResult> meshInspected(const TriangleMesh& input, InspectResult inspected, const MeshOptions& options,
                                 Progress& progress, SizingMesh* sizing);

}  // namespace qmcf
