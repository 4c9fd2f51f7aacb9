#include "morph_mesh.hpp"

#include <algorithm>
#include <limits>

#include "qmcf/base/math.hpp"
#include "qmcf/spatial/surface_walk.hpp"

namespace qmcf {

EditMesh::Vertex MorphMesh::place(const EditMesh::Vertex& from, const Vec3& position) const {
  constexpr double kMinCosine = 0.3;
  const Patch& patch = front_.patch();
  EditMesh::Vertex vertex;
  vertex.position = face_.closest(position, from.normal, kMinCosine).position;
  vertex.location = walkToClosest(patch.surface, from.location.triangle, vertex.position);
  vertex.normal = normalized(interpolate(patch.surface, patch.normal, vertex.location));
  return vertex;
}

double MorphMesh::lengthRatio(HalfedgeId h) const {
  const double after = length(h);
  const double before = length(front_.previousFront(h));
  const double shorter = std::min(after, before);
  return shorter > 0.0 ? std::max(after, before) / shorter : std::numeric_limits<double>::infinity();
}

double cornerAngleOf(const EditMesh& mesh, HalfedgeId h) {
  const Vec3 p = mesh.position(mesh.origin(h));
  const Vec3 u = mesh.position(mesh.target(h)) - p;
  const Vec3 v = mesh.position(mesh.origin(mesh.prev(h))) - p;
  return math::atan2(norm(cross(u, v)), dot(u, v));
}

}  // namespace qmcf
