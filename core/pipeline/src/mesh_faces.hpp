#pragma once

#include <optional>

#include "prepare.hpp"
#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/mesh/trace.hpp"
#include "qmcf/pipeline/mesh_surface.hpp"

namespace qmcf {

/// One face meshed by the first step of the ladder that gives a valid mesh, and how.
struct MeshedFace {
  FaceMesh mesh;
  std::vector<HalfedgeId> boundaryEdge;  ///< Per vertex: the patch's boundary edge that it halves; empty if none does.
  FaceReport report;
  std::vector<SizeLimit> tooCoarse;  ///< Where the first step failed, with the size that may help.
  FaceTrace trace;                   ///< Its history, if that was asked for.
};

/// Advancing front and clean-up; if the front got stuck or left an element that no solver takes, the paired triangles
/// of the background; failing that, the triangles themselves (H8 of docs/algorithm.md). The history is recorded in
/// `scale`, if given. Errors: cancelled.
Result<MeshedFace> meshFace(const TriangleMesh& mesh, const Brep& brep, const PreparedFaces& prepared,
                            std::int32_t face, const MeshOptions& options, const std::optional<TraceScale>& scale,
                            Progress& progress);

/// Cuts every element at the middles of its edges, so that only quadrilaterals are left, and relaxes them.
/// The history goes on in `scale`, if given. Errors: cancelled.
Result<MeshedFace> subdivideFace(const TriangleMesh& mesh, const Brep& brep, const PreparedFaces& prepared,
                                 const MeshedFace& face, const std::optional<TraceScale>& scale, Progress& progress);

/// Joins the faces' meshes at the nodes that they share. Faces without elements are left out.
QuadMesh joinFaces(const Brep& brep, const PreparedFaces& prepared, const std::vector<MeshedFace>& faces);

}  // namespace qmcf
