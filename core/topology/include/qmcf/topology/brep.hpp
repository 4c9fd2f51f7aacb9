#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/mesh/ids.hpp"
#include "qmcf/mesh/surface.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"

namespace qmcf {

/// Why an edge is an edge. Where several hold, the first in this order.
enum class EdgeKind : std::uint8_t { nonManifold, boundary, sharp, label };
std::string_view edgeKindName(EdgeKind kind);

/// A point where edges end, or where one edge turns sharply.
struct BrepVertex {
  std::int32_t point = kNone;  ///< Vertex of the mesh.
  bool artificial = false;     ///< Put on a closed smooth edge only so that it has an end.
};

/// A chain of mesh edges between two B-rep vertices (the same one when closed).
struct BrepEdge {
  EdgeKind kind = EdgeKind::sharp;
  std::vector<std::int32_t> points;  ///< Vertices of the mesh from start to end, at least two; closed: first == last.
  std::int32_t start = kNone;        ///< B-rep vertex.
  std::int32_t end = kNone;          ///< B-rep vertex.
  double length = 0.0;
  std::vector<std::int32_t> stops;  ///< Indices of inner points where a crease ended or branched; ascending.
};

/// One use of an edge by a loop. The face lies on its left.
struct Coedge {
  std::int32_t edge = kNone;
  bool reversed = false;     ///< The loop runs from the edge's end to its start.
  double cornerAngle = 0.0;  ///< Angle of the face's fan at the coedge's first vertex, in radians.
  /// Quads wanted there, 1..4: with q = 2 * cornerAngle / pi, 1 up to q = 1.25, 2 up to 2.75, 3 up to 3.5, else 4;
  /// 2 at an artificial vertex.
  std::int32_t cornerQuads = 2;
};

struct BrepLoop {
  std::vector<Coedge> coedges;
};

/// A connected piece of the surface between edges.
struct BrepFace {
  std::vector<std::int32_t> triangles;  ///< Triangles of the mesh, ascending.
  std::vector<BrepLoop> loops;          ///< Empty for a closed smooth surface.
  std::int32_t body = kNone;
  std::string name;  ///< From the file's labels, or "face N".
  double area = 0.0;
};

/// A connected component of the mesh.
struct BrepBody {
  std::vector<std::int32_t> faces;
  bool closed = false;
};

/// The triangles of one face as a manifold surface of its own, cut open along its edges.
struct FaceSurface {
  Surface surface;
  std::vector<std::int32_t> vertexPoint;  ///< Per surface vertex: vertex of the mesh. A cut vertex occurs repeatedly.
  std::vector<std::int32_t> triangleOrigin;  ///< Per surface triangle: triangle of the mesh.
  IdMap<HalfedgeId, std::int32_t> edge;      ///< Edge of the B-rep under a boundary half-edge; kNone elsewhere.
  /// Per boundary loop of the surface, in the order of BrepFace::loops: its half-edges, starting where the loop's first
  /// coedge starts.
  std::vector<std::vector<HalfedgeId>> loops;
};

/// The boundary representation recovered from a repaired mesh.
struct Brep {
  std::vector<BrepVertex> vertices;
  std::vector<BrepEdge> edges;
  std::vector<BrepFace> faces;
  std::vector<BrepBody> bodies;
  std::vector<std::int32_t> triangleFace;  ///< Per triangle of the mesh.
  std::vector<FaceSurface> cuts;           ///< Per face: its triangles, for the stages that work on them face by face.
};

/// Feature recognition.
struct BrepOptions {
  double featureAngle = 30.0;  ///< Dihedral angle in degrees, in (0, 180), from which an edge is sharp.
  /// Edges of the mesh, by their vertices, whose angle the file does not tell (RepairedMesh::flatEdges): creases go on
  /// along them, but with stops at their ends. Others than edges are ignored.
  std::vector<std::array<std::int32_t, 2>> flatEdges;
};

/// Cuts the mesh into faces along sharp, boundary, non-manifold and label edges.
///
/// - An edge is sharp from the feature angle on. Chains of sharp edges that end inside a face are continued down to 0.6
///   of the angle where that leads to another edge; those shorter than 0.3 % of the body that still end inside a face
///   are dropped. In a body whose sharp edges end loosely all over (scans, sculpted models) only edges of twice the
///   angle count, chains and patches must be larger, and zigzag borders have no corners.
/// - Slivers too thin for a reliable normal take that of a neighbour.
/// - Labels divide when their regions have four triangles or more on average.
/// - B-rep vertices are where other than two edges meet, where kinds change, where an edge or a face turns by more than
///   45 degrees, and where surfaces touch in a point of an edge. Surfaces that touch in a point without any edge do not
///   share it: each face has a vertex of its own there.
/// - Edges of Moebius-like pieces that repair() could not orient are non-manifold edges with two triangles.
///
/// \pre mesh comes from repair(): no degenerate triangle, no single non-manifold edge inside a sheet.
/// Complexity O(n log n). Errors: cancelled, noSurface, internal.
Result<Brep> recoverBrep(const TriangleMesh& mesh, const BrepOptions& options, Progress& progress);

}  // namespace qmcf
