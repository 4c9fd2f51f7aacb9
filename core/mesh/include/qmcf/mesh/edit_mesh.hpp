#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/mesh/ids.hpp"
#include "qmcf/mesh/surface.hpp"

namespace qmcf {

using FaceId = Id<struct FaceTag>;

/// What a face of an EditMesh is.
enum class FaceKind : std::uint8_t {
  removed,
  open,     ///< A triangle that is still to be meshed.
  element,  ///< A finished quadrilateral or triangle.
};

/// The working triangulation W: a conforming, consistently oriented manifold mix of open triangles and finished
/// elements, edited in place. Every edit is journalled: mark() and rollback() make any sequence of edits a transaction.
/// Half-edges keep their ids through flips and splits of the faces beside them, so an id is a stable name of a front
/// edge.
class EditMesh {
 public:
  /// Geometry of a vertex.
  struct Vertex {
    Vec3 position;
    Vec3 normal;            ///< Unit normal of the underlying surface.
    SurfacePoint location;  ///< Where it lies on the background surface.
    /// The input triangle that it was projected to, where later searches start; kNone if it never was.
    std::int32_t facet = kNone;
  };

  /// Is told of every commit, while the journal still is there.
  class Watcher {
   public:
    Watcher() = default;
    Watcher(const Watcher&) = delete;
    Watcher& operator=(const Watcher&) = delete;
    virtual ~Watcher() = default;
    virtual void onCommit(const EditMesh& mesh) = 0;
  };

  EditMesh() = default;
  /// Copies the surface with all triangles open; vertex, half-edge and face ids are those of the surface.
  EditMesh(const Surface& surface, const IdMap<VertexId, Vec3>& normals);
  /// Copies a quad-dominant mesh; vertex and face ids are its indices.
  /// \pre conforming, consistently oriented, one fan of elements at each vertex.
  explicit EditMesh(const FaceMesh& mesh);

  /// Upper bounds of the ids; removed ones are in between.
  [[nodiscard]] std::size_t vertexCapacity() const { return vertices_.size(); }
  [[nodiscard]] std::size_t halfedgeCapacity() const { return links_[kNext].size(); }
  [[nodiscard]] std::size_t faceCapacity() const { return links_[kFaceHalfedge].size(); }

  [[nodiscard]] HalfedgeId next(HalfedgeId h) const { return HalfedgeId(links_[kNext][h.index()]); }
  [[nodiscard]] HalfedgeId prev(HalfedgeId h) const { return HalfedgeId(links_[kPrev][h.index()]); }
  [[nodiscard]] HalfedgeId twin(HalfedgeId h) const { return HalfedgeId(links_[kTwin][h.index()]); }
  [[nodiscard]] VertexId origin(HalfedgeId h) const { return VertexId(links_[kOrigin][h.index()]); }
  [[nodiscard]] VertexId target(HalfedgeId h) const { return origin(next(h)); }
  [[nodiscard]] FaceId face(HalfedgeId h) const { return FaceId(links_[kFace][h.index()]); }
  [[nodiscard]] bool alive(HalfedgeId h) const { return links_[kOrigin][h.index()] != kNone; }
  [[nodiscard]] HalfedgeId outgoing(VertexId v) const { return HalfedgeId(links_[kOutgoing][v.index()]); }
  [[nodiscard]] bool alive(VertexId v) const { return links_[kOutgoing][v.index()] != kNone; }
  [[nodiscard]] bool isBoundary(VertexId v) const { return !twin(outgoing(v)).valid(); }
  [[nodiscard]] HalfedgeId halfedge(FaceId f) const { return HalfedgeId(links_[kFaceHalfedge][f.index()]); }
  [[nodiscard]] FaceKind kind(FaceId f) const { return static_cast<FaceKind>(links_[kFaceKind][f.index()]); }
  [[nodiscard]] bool isOpen(HalfedgeId h) const { return kind(face(h)) == FaceKind::open; }
  /// Next and previous outgoing half-edge around the origin, counter-clockwise and clockwise; invalid past a boundary.
  [[nodiscard]] HalfedgeId nextAround(HalfedgeId h) const { return twin(prev(h)); }
  [[nodiscard]] HalfedgeId prevAround(HalfedgeId h) const {
    const HalfedgeId t = twin(h);
    return t.valid() ? next(t) : HalfedgeId();
  }
  [[nodiscard]] const Vertex& vertex(VertexId v) const { return vertices_[v]; }
  [[nodiscard]] const Vec3& position(VertexId v) const { return vertices_[v].position; }
  [[nodiscard]] const Vec3& normal(VertexId v) const { return vertices_[v].normal; }
  /// The half-edge from a to b, or an invalid one. Complexity: valence of a.
  [[nodiscard]] HalfedgeId find(VertexId a, VertexId b) const;
  /// Whether a and b are joined by an edge, in either direction.
  [[nodiscard]] bool connected(VertexId a, VertexId b) const { return find(a, b).valid() || find(b, a).valid(); }
  /// The half-edges of a face, from halfedge(f) on; the fourth is invalid in a triangle.
  [[nodiscard]] std::array<HalfedgeId, 4> sides(FaceId f) const {
    const HalfedgeId first = halfedge(f);
    const HalfedgeId third = next(next(first));
    return {first, next(first), third, next(third) == first ? HalfedgeId() : next(third)};
  }
  /// Number of corners of a face.
  [[nodiscard]] int cornerCount(FaceId f) const { return next(next(next(halfedge(f)))) == halfedge(f) ? 3 : 4; }

  /// Calls visit(HalfedgeId) for each half-edge leaving v. For a boundary vertex counter-clockwise from the boundary
  /// edge.
  template <class Visit>
  void forEachOutgoing(VertexId v, Visit visit) const {
    const HalfedgeId first = outgoing(v);
    HalfedgeId h = first;
    do {
      const HalfedgeId following = nextAround(h);
      visit(h);
      h = following;
    } while (h.valid() && h != first);
  }

  /// Turns the diagonal of the two open triangles beside h. \pre both exist and the new edge does not.
  void flip(HalfedgeId h);
  /// Splits an open triangle into three at a new vertex.
  VertexId splitTriangle(FaceId f, const Vertex& vertex);
  /// Splits an edge and the open triangles beside it at a new vertex. \pre faces beside h are open triangles or none.
  VertexId splitEdge(HalfedgeId h, const Vertex& vertex);
  /// Replaces the faces of a simply connected region by one face. boundary: its 3 or 4 half-edges, in order, inside the
  /// region; region: all its faces. Vertices strictly inside are removed.
  FaceId fill(const std::vector<HalfedgeId>& boundary, const std::vector<FaceId>& region, FaceKind kind);
  /// Replaces the faces of a simply connected region by several elements. cells: their corners as indices into the
  /// boundary's origins, counter-clockwise; indices from boundary.size() on are the new vertices `inner`.
  std::vector<FaceId> fill(const std::vector<HalfedgeId>& boundary, const std::vector<FaceId>& region,
                           const std::vector<std::array<int, 4>>& cells, const std::vector<Vertex>& inner);
  /// Cuts a face in two by an edge between the origins of two of its half-edges that are not neighbours. Returns the
  /// new half-edge from origin(from) to origin(to); its face is new.
  HalfedgeId cut(HalfedgeId from, HalfedgeId to);
  /// Contracts h by moving its target into its origin; the target and the triangles beside h disappear.
  /// \pre canCollapse(h)
  void collapse(HalfedgeId h);
  /// Whether collapse(h) keeps the mesh manifold: faces beside h are triangles, no other face touches both ends, the
  /// ends have no other common neighbours, the target is inside.
  [[nodiscard]] bool canCollapse(HalfedgeId h) const;
  void setKind(FaceId f, FaceKind kind) { set(kFaceKind, f.index(), static_cast<std::int32_t>(kind)); }
  void setVertex(VertexId v, const Vertex& vertex);

  /// The present state, to be given to rollback(). Marks nest.
  [[nodiscard]] std::size_t mark() const { return journal_.size(); }
  /// Undoes all edits since the mark was taken.
  void rollback(std::size_t mark);
  /// Forgets the journal: earlier marks become invalid.
  void commit() {
    if (watcher_ != nullptr) watcher_->onCommit(*this);
    journal_.clear();
    savedVertices_.clear();
  }

  /// commit() where nobody is told: keeps the journal of many small edits short.
  void commitUnwatched() {
    if (watcher_ == nullptr) commit();
  }

  /// Who is told of commits; nullptr: nobody. It must outlive the mesh.
  void watch(Watcher* watcher) { watcher_ = watcher; }
  /// What the journal holds, ascending: faces that changed in kind or corners, vertices that moved. Some may be back as
  /// they were, or gone.
  struct Changes {
    std::vector<FaceId> faces;
    std::vector<VertexId> vertices;
  };
  [[nodiscard]] Changes changes() const;
  /// The same without an order; some are visited often.
  template <class VisitFace, class VisitVertex>
  void forEachChange(VisitFace visitFace, VisitVertex visitVertex) const;

 private:
  enum Array : std::uint8_t { kNext, kPrev, kTwin, kOrigin, kFace, kOutgoing, kFaceHalfedge, kFaceKind, kArrayCount };
  enum class Edit : std::uint8_t { word, vertex, newVertex, newHalfedges, newFace };
  struct Entry {
    Edit edit;
    std::uint8_t array;
    std::int32_t index;
    std::int32_t value;
  };

  void set(Array array, std::size_t index, std::int32_t value);
  void link(HalfedgeId first, HalfedgeId second);
  void glue(HalfedgeId a, HalfedgeId b);
  void makeTriangle(FaceId f, HalfedgeId a, HalfedgeId b, HalfedgeId c);
  VertexId addVertex(const Vertex& vertex);
  /// A pair of new half-edges a -> b and b -> a, glued; the first is returned, the second has the next id.
  HalfedgeId addEdge(VertexId a, VertexId b);
  FaceId addFace(FaceKind kind);
  void removeHalfedge(HalfedgeId h);
  /// Removes what lies inside the boundary; the boundary's half-edges are left without next, previous and face.
  void clear(const std::vector<HalfedgeId>& boundary, const std::vector<FaceId>& region);

  std::array<std::vector<std::int32_t>, kArrayCount> links_;
  IdMap<VertexId, Vertex> vertices_;
  std::vector<Entry> journal_;
  std::vector<Vertex> savedVertices_;
  Watcher* watcher_ = nullptr;
};

template <class VisitFace, class VisitVertex>
void EditMesh::forEachChange(VisitFace visitFace, VisitVertex visitVertex) const {
  std::size_t newFaces = 0;
  for (const Entry& entry : journal_) {
    const auto index = static_cast<std::size_t>(entry.index);
    if (entry.edit == Edit::vertex) visitVertex(VertexId(index));
    if (entry.edit == Edit::newFace) ++newFaces;
    if (entry.edit != Edit::word) continue;
    if (entry.array == kFaceHalfedge || entry.array == kFaceKind) visitFace(FaceId(index));
    if (entry.array > kFace || !alive(HalfedgeId(index)) || !face(HalfedgeId(index)).valid()) continue;
    visitFace(face(HalfedgeId(index)));
  }
  for (std::size_t f = faceCapacity() - newFaces; f < faceCapacity(); ++f) visitFace(FaceId(f));
}

}  // namespace qmcf
