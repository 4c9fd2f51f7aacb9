#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "qmcf/field/cross_field.hpp"
#include "qmcf/front/local_plane.hpp"
#include "qmcf/mesh/edit_mesh.hpp"
#include "qmcf/mesh/patch.hpp"

namespace qmcf {

/// The working triangulation with the questions that an advancing front asks it. A front edge is a half-edge of an open
/// triangle whose other side is an element or nothing; the open region lies on its left.
/// The sector of a front edge a -> b is the fan of open triangles at a, counter-clockwise from a -> b up to the
/// previous front edge. A vertex where the front touches itself has several sectors.
class FrontMesh {
 public:
  FrontMesh(const Patch& patch, const CrossField& field);

  EditMesh& mesh() { return mesh_; }
  [[nodiscard]] const EditMesh& mesh() const { return mesh_; }
  [[nodiscard]] const Patch& patch() const { return patch_; }
  [[nodiscard]] const CrossField& field() const { return field_; }

  [[nodiscard]] bool isFront(HalfedgeId h) const {
    if (!mesh_.alive(h) || !mesh_.isOpen(h)) return false;
    const HalfedgeId t = mesh_.twin(h);
    return !t.valid() || !mesh_.isOpen(t);
  }
  [[nodiscard]] HalfedgeId nextFront(HalfedgeId h) const;
  [[nodiscard]] HalfedgeId previousFront(HalfedgeId h) const;
  /// Number of front edges in h's loop, or nothing when it has more than limit.
  [[nodiscard]] std::optional<int> loopLength(HalfedgeId h, int limit) const;

  /// Whether h's loop encloses the open region in front of it, rather than being an island in it: its angles sum to
  /// less than a straight line at each vertex.
  [[nodiscard]] bool turnsInward(HalfedgeId h) const;

  /// Boundary vertices of the patch can't move.
  [[nodiscard]] bool isFixed(VertexId v) const { return mesh_.isBoundary(v); }
  /// Inside the open region, touching no element and no boundary.
  [[nodiscard]] bool isFree(VertexId v) const;
  /// Sum of the angles of the sector's triangles at origin(h), in radians. \pre isFront(h)
  [[nodiscard]] double sectorAngle(HalfedgeId h) const;
  /// Elements and sectors around a vertex.
  struct Surroundings {
    int elements = 0;
    int sectors = 0;
  };
  [[nodiscard]] Surroundings surroundings(VertexId v) const;
  /// Number of quads that the sector of h should get: round(2 angle / pi), inclined towards the number that makes the
  /// vertex regular (D3). 0 means that the sector should be closed by a seam.
  [[nodiscard]] int wantedQuads(HalfedgeId h) const;

  [[nodiscard]] double sizeAt(const SurfacePoint& point) const;
  /// The direction of the cross field at a point that is closest to the given one.
  [[nodiscard]] Vec3 crossNear(const SurfacePoint& point, const Vec3& direction) const;
  /// A vertex on the surface close to a position in space.
  [[nodiscard]] EditMesh::Vertex vertexNear(const SurfacePoint& start, const Vec3& position) const;

  /// Moves a vertex if all faces around it stay at least as good as `least`, or as they were if they were worse.
  bool tryMove(VertexId v, const EditMesh::Vertex& moved, double least);

 private:
  const Patch& patch_;
  const CrossField& field_;
  EditMesh mesh_;
};

/// The plane in which things that concern two vertices are decided.
LocalPlane planeBetween(const EditMesh& mesh, VertexId a, VertexId b);

}  // namespace qmcf
