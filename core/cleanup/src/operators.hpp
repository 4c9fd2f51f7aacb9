#pragma once

#include <cstdint>
#include <unordered_set>
#include <utility>
#include <vector>

#include "cavity.hpp"
#include "qmcf/cleanup/cleanup.hpp"
#include "qmcf/mesh/edit_mesh.hpp"
#include "qmcf/mesh/side_pattern.hpp"
#include "relaxation.hpp"
#include "triangle_ways.hpp"

namespace qmcf {

/// Topological clean-up of one face (D9 of docs/algorithm.md). An operator is applied where it lowers the irregularity
/// energy, the sum of (elements - wanted)^2 over the vertices (see irregularity()), and after relaxation nearby no
/// element is worse than options.leastShape, or than the worst before if that was less.
class TopologicalCleanup {
 public:
  static constexpr std::int32_t kRegular = 4;  ///< Elements around a regular vertex inside.

  /// wanted: per vertex of the mesh as it is now, the elements that make it regular; kRegular for those to come.
  TopologicalCleanup(EditMesh& mesh, std::vector<std::int32_t> wanted, const RelaxationTarget& target,
                     const CleanupOptions& options, TraceRecorder* trace);

  /// One pass of the small operators over the mesh. Returns the number of changes.
  std::int64_t pass();
  /// One pass of cavity remeshing, for a mesh on which the small operators have done what they can. Returns the number
  /// of changes.
  std::int64_t cavityPass();
  /// Pairs triangles that are far from each other, for a mesh on which cavities have done what they can. Returns the
  /// number of pairs.
  std::int64_t distantPass();
  /// Pairs triangles at any price that leaves elements a solver takes. Does nothing more once it is cancelled.
  void pairAll(Progress& progress);
  /// The vertices around all changes since this was called last; some may have been removed since.
  std::vector<VertexId> takeTouched() { return std::exchange(touched_, {}); }
  [[nodiscard]] const CleanupStatistics& statistics() const { return statistics_; }

 private:
  /// What the next commits are, for the trace.
  void note(TraceKind kind) {
    if (trace_ != nullptr) trace_->next(kind);
  }
  /// Elements around a vertex, less the number that makes it regular.
  [[nodiscard]] int excess(VertexId v) const;
  bool removeDoublet(VertexId v);
  bool pairTriangles(HalfedgeId h);
  /// Makes quads of two triangles and what lies between them: of path_, `from`, so many quads and a triangle that
  /// follow.
  bool bridgeTriangles(FaceId from, std::size_t quads);
  std::int64_t bridgeAllTriangles();
  /// What two triangles may cost that become quads with all between.
  struct PairLimits {
    double leastShape = 0.0;  ///< No element may be worse than this and than the worst before.
    bool atAnyPrice = false;  ///< Whatever that does to the energy and to the mean shape.
  };
  /// Makes quads of the triangles at the ends of a way and of all between.
  bool joinAlong(const TriangleWay& way, const PairLimits& limits);
  bool fillAnyhow(double least);
  bool fillWithBeside(std::vector<FaceId>& faces, std::size_t most, double least);
  bool mendPoor(const std::vector<VertexId>& vertices, double least);
  bool collapseDiagonal(HalfedgeId corner);
  /// Fills cavity_ anew if that is better.
  bool refill();
  bool refillAround(VertexId v);
  bool remeshCavity(VertexId seed);
  [[nodiscard]] std::vector<int> wantedInside(const std::vector<HalfedgeId>& loop) const;
  bool grow(const std::vector<VertexId>& around);
  bool fillCavity(const std::vector<HalfedgeId>& loop, const std::vector<int>& corners);
  /// What a cavity is like before it is filled with a pattern.
  struct Measures {
    std::size_t triangles = 0;
    double count = 0.0;  ///< Of its quads and pairs of triangles.
    double least = 0.0;  ///< Shape below which no new element may be.
    double meanShape = 0.0;
    double stretch = 0.0;     ///< Of all its elements together.
    double distortion = 0.0;  ///< The same and how far their sizes are off.
  };
  [[nodiscard]] Measures measureCavity(std::size_t triangles, double count) const;
  [[nodiscard]] std::vector<EditMesh::Vertex> innerVertices(const SidePattern& pattern,
                                                            const RelaxationTarget& rough) const;
  bool settleFilled(const std::vector<FaceId>& filled, const std::vector<VertexId>& moving,
                    const RelaxationTarget& rough, double allowed);
  bool fillWith(const SidePattern& pattern, const std::vector<HalfedgeId>& loop, const Measures& before, int drop);
  /// Relaxes around the vertices. Returns whether no element there has a shape below `least` then.
  bool becomesGood(const std::vector<VertexId>& vertices, double least, int sweeps);
  /// The same, and keeps the change since mark if no element there has a shape below `least`.
  bool settle(const std::vector<VertexId>& vertices, double least, std::size_t mark);

  EditMesh& mesh_;
  std::vector<std::int32_t> wanted_;
  const RelaxationTarget& target_;
  const CleanupOptions& options_;
  CleanupStatistics statistics_;
  TraceRecorder* trace_;       ///< nullptr: nobody wants the history.
  std::vector<FaceId> path_;   ///< See bridgeTriangles().
  Cavity cavity_;              ///< The region being looked at.
  std::size_t fillsLeft_ = 0;  ///< How many more fillings fillAnyhow() may try.
  /// Signatures of cavities that no pattern was found for. Their faces have other ids once something changes there.
  std::unordered_set<std::uint64_t> triedCavities_;
  /// Likewise of small ones, and of the elements around their vertices.
  std::unordered_set<std::uint64_t> triedRefills_;
  std::vector<VertexId> touched_;  ///< See takeTouched().
};

/// The vertices and all those of the elements around them, ascending.
std::vector<VertexId> withNeighbours(const EditMesh& mesh, const std::vector<VertexId>& vertices);

/// The worst faceShape() around the vertices.
double worstAround(const EditMesh& mesh, const std::vector<VertexId>& vertices);

struct ElementCounts {
  std::int64_t elements = 0;
  std::int64_t triangles = 0;  ///< Of these.
};

ElementCounts countElements(const EditMesh& mesh);

/// Quads between two triangles that become quads with them; more make a loop that is longer than there are fillings
/// for.
inline constexpr std::size_t kLongestBridge = 3;

/// Where there are more triangles a front got stuck, and the ways between them are past counting.
inline constexpr std::int64_t kFewTriangles = 200;

}  // namespace qmcf
