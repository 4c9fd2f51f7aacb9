#pragma once

#include <cstdint>

#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/ids.hpp"
#include "qmcf/mesh/surface.hpp"

namespace qmcf {

/// One face of the B-rep as a clean triangulation of its own (S0 of the paper): geometry, boundary and size.
/// Faces share nothing but the nodes on their edges; a face that touches an edge on both sides has two copies of its
/// nodes.
struct Patch {
  std::int32_t face = kNone;           ///< Face of the B-rep.
  Surface surface;                     ///< One connected component.
  IdMap<VertexId, Vec3> normal;        ///< Unit normal of the smooth face.
  IdMap<VertexId, double> size;        ///< Target edge length h > 0 of the quad mesh.
  IdMap<VertexId, std::int32_t> node;  ///< Shared node on the edges of the B-rep; kNone inside the face.
  IdMap<VertexId, std::int32_t>
      cornerQuads;                       ///< Quads wanted at a boundary vertex, 1 to 4 (2 inside an edge); 0 inside.
  IdMap<HalfedgeId, std::int32_t> edge;  ///< Edge of the B-rep under a boundary half-edge; kNone elsewhere.
};

}  // namespace qmcf
