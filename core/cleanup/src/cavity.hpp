#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "qmcf/base/random.hpp"
#include "qmcf/mesh/edit_mesh.hpp"

namespace qmcf {

/// A set of ids that is emptied in constant time: made once, used for many small regions of one mesh.
template <class Key>
class IdSet {
 public:
  void clear() { ++now_; }
  /// Returns whether the id is new.
  bool insert(Key id) {
    if (id.index() >= stamp_.size()) stamp_.resize(2 * id.index() + 1, 0);
    const bool isNew = stamp_[id.index()] != now_;
    stamp_[id.index()] = now_;
    return isNew;
  }
  [[nodiscard]] bool contains(Key id) const { return id.index() < stamp_.size() && stamp_[id.index()] == now_; }

 private:
  std::vector<std::uint64_t> stamp_;
  std::uint64_t now_ = 1;
};

/// Faces of a mesh that may be filled anew.
class Cavity {
 public:
  void clear() {
    faces_.clear();
    inside_.clear();
    signature_ = 0;
  }
  /// Adds a face that is not there yet.
  void add(FaceId f) {
    if (!inside_.insert(f)) return;
    faces_.push_back(f);
    signature_ += Random(f.index()).next();
  }
  [[nodiscard]] bool contains(FaceId f) const { return inside_.contains(f); }
  [[nodiscard]] std::size_t size() const { return faces_.size(); }
  /// In the order in which they were added.
  [[nodiscard]] const std::vector<FaceId>& faces() const { return faces_; }
  /// The same for the same faces in any order, and for others in all likelihood another.
  [[nodiscard]] std::uint64_t signature() const { return signature_; }
  /// The boundary as one loop without repeated vertices, or nothing; nothing either where the faces wind around a
  /// handle of the surface that what is filled in would close.
  [[nodiscard]] std::optional<std::vector<HalfedgeId>> boundaryLoop(const EditMesh& mesh);
  /// Whether cells that fill the loop, given as for EditMesh::fill(), join vertices that an edge outside joins already:
  /// what lies between the two edges, a hole even, would be lost where the mesh is told by its vertices alone.
  [[nodiscard]] bool doublesEdge(const EditMesh& mesh, const std::vector<HalfedgeId>& loop,
                                 const std::vector<std::array<int, 4>>& cells) const;
  /// The vertices of the faces, each once, in the order in which they are met.
  [[nodiscard]] const std::vector<VertexId>& vertices(const EditMesh& mesh);
  /// Elements of the cavity around a vertex.
  [[nodiscard]] int countAround(const EditMesh& mesh, VertexId v) const;

 private:
  /// Whether the Euler characteristic of the faces, which have so many edges on their boundary, is that of a disc.
  [[nodiscard]] bool isDisc(const EditMesh& mesh, std::size_t borders);

  std::vector<FaceId> faces_;
  std::uint64_t signature_ = 0;
  IdSet<FaceId> inside_;
  IdSet<VertexId> onLoop_;
  IdSet<VertexId> met_;
  std::vector<VertexId> vertices_;
};

/// The vertices of the faces, ascending.
std::vector<VertexId> cornersOf(const EditMesh& mesh, const std::vector<FaceId>& faces);

/// The faces around those of the vertices that are still there, ascending.
std::vector<FaceId> facesAround(const EditMesh& mesh, const std::vector<VertexId>& vertices);

/// What a vertex adds to the irregularity energy. A boundary vertex with too few elements has a straight or reflex
/// corner in one of them, which no relaxation can mend.
int irregularity(bool boundary, int excess);

/// What a triangle adds to it.
inline constexpr int kTriangleEnergy = 4;

std::size_t triangleCount(const EditMesh& mesh, const std::vector<FaceId>& faces);
bool allQuads(const EditMesh& mesh, const std::vector<FaceId>& faces);

/// The smallest faceShape() of the faces.
double worstOf(const EditMesh& mesh, const std::vector<FaceId>& faces);

}  // namespace qmcf
