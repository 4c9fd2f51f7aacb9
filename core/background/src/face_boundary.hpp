#pragma once

#include <cstdint>
#include <vector>

#include "face_reference.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/sizing/divide.hpp"
#include "qmcf/topology/brep.hpp"
#include "remesh_mesh.hpp"

namespace qmcf {

/// The boundary of a face with its division nodes in place. A mark on a boundary half-edge is an index into coedges.
struct FaceBoundary {
  std::vector<Coedge> coedges;            ///< All coedges of the face, loop by loop.
  std::vector<std::int32_t> firstVertex;  ///< Per coedge: the vertex of the mesh where it starts.
  std::vector<double> nodeSize;           ///< Per vertex of the mesh: size at nodes, 0 elsewhere.
  std::vector<double> spacing;  ///< Per vertex of the mesh: mean distance of nodes to their neighbours, 0 elsewhere.
};

/// The face's surface as an editable mesh with its division nodes inserted in the boundary; the other boundary vertices
/// are points to be removed.
FaceBoundary insertNodes(RemeshMesh& mesh, const TriangleMesh& input, const Brep& brep, std::int32_t face,
                         const FaceSurface& cut, const FaceReference& reference, const DividedEdges& divided);

}  // namespace qmcf
