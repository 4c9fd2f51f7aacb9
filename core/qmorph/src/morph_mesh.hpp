#pragma once

#include "qmcf/field/cross_field.hpp"
#include "qmcf/front/front_mesh.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"

namespace qmcf {

/// The working triangulation of Q-Morph and the surface that its nodes lie on. There is no cross field.
class MorphMesh {
 public:
  MorphMesh(const Patch& patch, const TriangleBvh& face) : face_(face), front_(patch, noField_) {}

  [[nodiscard]] FrontMesh& front() { return front_; }
  [[nodiscard]] const FrontMesh& front() const { return front_; }
  [[nodiscard]] EditMesh& mesh() { return front_.mesh(); }
  [[nodiscard]] const EditMesh& mesh() const { return front_.mesh(); }

  /// The place on the face nearest to a position in space; from: a vertex near it.
  [[nodiscard]] EditMesh::Vertex place(const EditMesh::Vertex& from, const Vec3& position) const;
  [[nodiscard]] double length(HalfedgeId h) const {
    return distance(mesh().position(mesh().origin(h)), mesh().position(mesh().target(h)));
  }
  /// Longer over shorter of the two front edges that meet at the origin of the front edge h.
  [[nodiscard]] double lengthRatio(HalfedgeId h) const;

 private:
  CrossField noField_;
  const TriangleBvh& face_;
  FrontMesh front_;
};

/// Angle at origin(h) in the face of h, in radians.
double cornerAngleOf(const EditMesh& mesh, HalfedgeId h);

}  // namespace qmcf
