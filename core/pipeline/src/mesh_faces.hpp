#pragma once

#include <optional>

#include "part.hpp"
#include "prepare.hpp"
#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/mesh/trace.hpp"
#include "qmcf/pipeline/mesh_surface.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"
#include "shared_nodes.hpp"

namespace qmcf {

/// The mesh of a face with every element cut at the middles of its edges, so that only quadrilaterals are left.
struct CutFace {
  FaceMesh mesh;
  std::vector<HalfedgeId> halves;  ///< Per vertex: the patch's boundary edge that it halves; invalid elsewhere.
  FaceReport report;
  FaceTrace trace;
};

/// One face meshed by the first step of the ladder that gives a valid mesh, and how.
struct MeshedFace {
  FaceMesh mesh;
  FaceReport report;
  std::vector<SizeLimit> tooCoarse;  ///< Where the first step failed, with the size that may help.
  FaceTrace trace;                   ///< Its history, if that was asked for.
  std::optional<CutFace> cut;        ///< What it was cut in, once it was.
};

/// Advancing front and clean-up; if the front got stuck or left an element that no solver takes, the paired triangles
/// of the background; failing that, the triangles themselves (H8 of docs/algorithm.md). The history is recorded if the
/// part has a scale for it. Errors: cancelled.
Result<MeshedFace> meshFace(const Part& part, const PreparedFaces& prepared, std::int32_t face, Progress& progress);

/// A face's mesh with its ties to the others.
struct SharedFace {
  FaceMesh mesh;
  std::vector<std::int32_t> node;  ///< Per vertex: the node that it shares with other faces; kNone inside.
  FaceReport report;
  FaceTrace trace;
};

/// The mesh of a face as it is. Node numbers are those of the last prepareFaces() or refineFaces().
SharedFace shareFace(const MeshedFace& face, const PreparedFaces& prepared);

/// The same of what the face was cut in. halved: the nodes of the boundary with the middles between them.
SharedFace shareCut(const CutFace& face, const PreparedFaces& prepared, const SharedNodes& halved);

/// Cuts every element of a face at the middles of its edges, and relaxes what that makes. whole: the tree over all
/// triangles of the part; halved: the nodes of the boundary with those middles, of which only the places matter. The
/// history goes on. Errors: cancelled.
Result<CutFace> cutFace(const Part& part, const PreparedFaces& prepared, const TriangleBvh& whole,
                        const MeshedFace& face, const SharedNodes& halved, Progress& progress);

/// Makes quads of all triangles of a face, in pairs, with whatever lies between them; those stay that it can't be done
/// for. The history goes on. Errors: cancelled.
Result<MeshedFace> pairFace(const Part& part, const PreparedFaces& prepared, const MeshedFace& face,
                            Progress& progress);

/// Turns back elements of a face that the check against the part finds turned over, as far as moving vertices and
/// changing connections can; the face as it is, if that would leave an element that no solver takes. whole: the tree
/// over all triangles of the part; quadsOnly: no triangle may be made. The history goes on. Errors: cancelled.
Result<MeshedFace> mendFace(const Part& part, const PreparedFaces& prepared, const TriangleBvh& whole, bool quadsOnly,
                            const MeshedFace& face, Progress& progress);

}  // namespace qmcf
