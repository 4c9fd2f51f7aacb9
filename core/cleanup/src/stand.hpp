#pragma once

#include <vector>

#include "qmcf/mesh/edit_mesh.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"
#include "relaxation.hpp"

namespace qmcf {

/// How an element stands on the face.
struct Stand {
  bool turnedOver = false;
  double penalty = 0.0;  ///< 0 when every corner is upright and well shaped.
};

/// A corner is turned over when it faces against the surface both below itself and below the element's centre, or is
/// reflex; also when the check against the part would find it so, if there is a part to check against.
Stand standOf(const EditMesh& mesh, const RelaxationTarget& target, FaceId f);

/// Moves the vertex to the place around it where its elements stand best. Returns whether that helped.
bool moveToBest(EditMesh& mesh, const RelaxationTarget& target, VertexId v);

/// Elements around some vertices that are turned over, and their penalty.
struct Damage {
  int turnedOver = 0;
  double penalty = 0.0;

  friend bool operator<(const Damage& a, const Damage& b) {
    return a.turnedOver != b.turnedOver ? a.turnedOver < b.turnedOver : a.penalty < b.penalty;
  }
};

/// Of the elements around those of the vertices that are still there, each counted once.
Damage damageAround(const EditMesh& mesh, const RelaxationTarget& target, const std::vector<VertexId>& vertices);

}  // namespace qmcf
