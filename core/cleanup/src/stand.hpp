#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "qmcf/mesh/edit_mesh.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"
#include "relaxation.hpp"

namespace qmcf {

/// How an element stands on the face.
struct Stand {
  bool turnedOver = false;
  double penalty = 0.0;  ///< 0 when every corner is upright and well shaped.
  double square = 1.0;   ///< The least sine at a corner, for a quadrilateral by its own normal.
};

/// A corner is turned over when it faces against the surface both below itself and below the element's centre, or is
/// reflex; also when the check against the part would find it so, if there is a part to check against. Once the penalty
/// is known to be as high as `most`, the rest is left out.
Stand standOf(const EditMesh& mesh, const RelaxationTarget& target, FaceId f, double most = HUGE_VAL);

/// The same by the element's shape alone: it is turned over no more and its penalty is no higher than in truth.
Stand shapeOf(const EditMesh& mesh, FaceId f);

/// Moves the vertex to the place around it where its elements stand best. Returns whether that helped.
bool moveToBest(EditMesh& mesh, const RelaxationTarget& target, VertexId v);

/// Elements around some vertices that are turned over, and their penalty.
struct Damage {
  int turnedOver = 0;
  double penalty = 0.0;

  Damage& operator+=(const Stand& stand) {
    turnedOver += stand.turnedOver ? 1 : 0;
    penalty += stand.penalty;
    return *this;
  }
  friend bool operator<(const Damage& a, const Damage& b) {
    return a.turnedOver != b.turnedOver ? a.turnedOver < b.turnedOver : a.penalty < b.penalty;
  }
};

inline constexpr Damage kAnyDamage{std::numeric_limits<int>::max(), HUGE_VAL};

/// Of the elements around those of the vertices that are still there, each counted once. Where it is not less than
/// `most`, the answer may be anything from `most` to the truth.
Damage damageAround(const EditMesh& mesh, const RelaxationTarget& target, const std::vector<VertexId>& vertices,
                    const Damage& most = kAnyDamage);

}  // namespace qmcf
