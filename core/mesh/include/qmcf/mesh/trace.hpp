#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/edit_mesh.hpp"

namespace qmcf {

/// What a step of a face's history is.
enum class TraceKind : std::uint8_t {
  start,         ///< A front before its first element; all of the face is open. Begins anew.
  star,          ///< The pattern at a singularity.
  seed,          ///< The first element where no front begins by itself.
  quad,          ///< A quadrilateral on a front edge.
  collision,     ///< One that joins the front to itself or to another one.
  closure,       ///< What filled a small loop.
  seam,          ///< A narrow wedge that was closed by merging vertices.
  transition,    ///< An edge between a short and a long one that was split.
  leftover,      ///< What the front could not mesh, as triangles and pairs of them.
  paired,        ///< Instead of a front: the triangulation with its triangles paired. Begins anew.
  strip,         ///< Instead of a front: one row of elements between the nodes of the boundary. Begins anew.
  triangulated,  ///< Instead of a front: the triangulation as it is. Begins anew.
  cleanup,       ///< The mesh that is handed to the clean-up. Begins anew.
  smooth,        ///< Vertices that were relaxed.
  doublet,       ///< A vertex with two elements that was removed.
  pair,          ///< Two triangles that became a quadrilateral.
  collapse,      ///< A quadrilateral that was closed along a diagonal.
  refill,        ///< A few elements that were replaced.
  cavity,        ///< Many elements that were replaced by a pattern.
  untangle,      ///< Vertices that were moved to turn elements back, and quadrilaterals that were cut.
  subdivision,   ///< Every element cut at the middles of its edges. Begins anew.
};
/// The kind's name; the same in C++, JSON and TypeScript.
std::string_view traceKindName(TraceKind kind);

/// How far a front edge is from getting its quadrilateral.
enum class TraceState : std::int8_t {
  bothSides,  ///< Both side edges are there.
  oneSide,    ///< One is missing.
  noSide,     ///< Both are missing.
  seam,       ///< The front is so narrow at one end that it shall be closed there.
};

/// How coordinates are rounded: p is kept as the whole numbers nearest to (p - origin) / unit.
struct TraceScale {
  Vec3 origin;
  double unit = 1.0;  ///< > 0

  friend bool operator==(const TraceScale&, const TraceScale&) = default;
};

/// One committed change of a face's mesh. Vertices and elements are numbered in the order in which they first appear
/// since the mesh last began anew; an element keeps its number when its corners change.
struct TraceStep {
  TraceKind kind = TraceKind::start;
  bool isReset = false;                            ///< The mesh begins anew: nothing of what was before is left.
  std::array<std::int32_t, 2> base{kNone, kNone};  ///< The front edge that it was made on, if any.
  std::int32_t pass = 0;                           ///< How desperate the front was, 0 to 2.
  std::int32_t undone = 0;                         ///< Attempts since the last step that were rolled back.
  std::vector<std::int32_t> failed;  ///< Pairs of vertices: front edges put off since the last step, at most 32.
  std::vector<std::vector<std::int32_t>> boundary;    ///< Of a mesh that begins anew: the face's loops.
  std::vector<std::array<std::int32_t, 4>> vertices;  ///< Vertex, x, y, z: new ones and those that moved.
  std::vector<std::array<std::int32_t, 5>> elements;  ///< Element and corners, kNone for no fourth: new or changed.
  std::vector<std::int32_t> removed;                  ///< Elements.
  std::vector<std::array<std::int32_t, 3>> states;    ///< Origin and target of a front edge, TraceState.
};

/// How one face was meshed. The front at a step is made of the edges with an element on one side only that are not on
/// the boundary and of the boundary edges without an element. Memory: proportional to the number of changes.
struct FaceTrace {
  std::vector<TraceStep> steps;

  friend bool operator==(const FaceTrace&, const FaceTrace&);
};

/// Writes the history of a face from what its meshes commit. Where nobody wants it, there is none, and a null pointer
/// in its place.
class TraceRecorder final : public EditMesh::Watcher {
 public:
  TraceRecorder(FaceTrace& trace, const TraceScale& scale) : trace_(trace), scale_(scale) {}

  /// A mesh begins: its elements so far are a step, and what it commits from now on are the next ones.
  void begin(TraceKind kind, EditMesh& mesh);
  /// What the next commits are.
  void next(TraceKind kind) { next(kind, kNone, kNone, 0); }
  void next(TraceKind kind, std::int32_t a, std::int32_t b, std::int32_t pass);
  /// An attempt was undone; the front edge a -> b was put off. Ids are the mesh's.
  void undone() { ++pending_.undone; }
  void failed(VertexId a, VertexId b);
  /// The state that a front edge got with the last step.
  void state(VertexId a, VertexId b, TraceState state);

  void onCommit(const EditMesh& mesh) override;

 private:
  std::int32_t vertexNumber(const EditMesh& mesh, VertexId v);
  [[nodiscard]] std::array<std::int32_t, 3> rounded(const Vec3& p) const;
  void noteFace(const EditMesh& mesh, FaceId f);
  void noteVertex(const EditMesh& mesh, VertexId v);
  void noteBoundary(const EditMesh& mesh);
  [[nodiscard]] std::int32_t known(VertexId v) const;
  bool joinSmoothing();

  /// What the player has of an element.
  struct Shown {
    std::int32_t number = kNone;
    bool isThere = false;
    std::array<std::int32_t, 4> corners{};
  };

  FaceTrace& trace_;
  TraceScale scale_;
  TraceStep pending_;
  std::int32_t vertexCount_ = 0;
  std::int32_t elementCount_ = 0;
  std::vector<std::int32_t> vertexNumber_;              ///< Per vertex of the mesh; kNone: not in any element yet.
  std::vector<std::array<std::int32_t, 3>> positions_;  ///< Per number: as last written.
  std::vector<Shown> shown_;                            ///< Per face of the mesh.
};

}  // namespace qmcf
