#include "failed_attempts.hpp"

namespace qmcf {
namespace {

/// How far an attempt looks, in element sizes or lengths of the front's edges, whichever are longer: a walk of 2.6
/// sizes, front nodes within 2 of a side edge's end, loops of up to ten edges.
constexpr double kReach = 5.0;
/// With more changes than this since the failure, one of them is near.
constexpr std::size_t kMostChanges = 2000;

}  // namespace

void FailedAttempts::noteChange(const EditMesh& mesh) {
  const EditMesh::Changes changed = mesh.changes();
  std::vector<Vec3> points;
  for (const FaceId f : changed.faces) {
    if (mesh.kind(f) == FaceKind::removed) continue;
    for (const HalfedgeId h : mesh.sides(f)) {
      if (h.valid()) points.push_back(mesh.position(mesh.origin(h)));
    }
  }
  for (const VertexId v : changed.vertices) {
    if (!mesh.alive(v)) continue;
    mesh.forEachOutgoing(v, [&](HalfedgeId h) { points.push_back(mesh.position(mesh.target(h))); });
  }
  Change change;
  for (const Vec3& p : points) change.centre += p / static_cast<double>(points.size());
  for (const Vec3& p : points) change.radius = std::max(change.radius, distance(p, change.centre));
  changes_.push_back(change);
}

void FailedAttempts::noteFailure(HalfedgeId h, int pass) {
  if (h.index() >= failures_.size()) failures_.resize(std::max(h.index() + 1, 2 * failures_.size()));
  failures_[h.index()][static_cast<std::size_t>(pass)] = changes_.size();
}

bool FailedAttempts::isVain(const FrontMesh& front, HalfedgeId h, int pass) const {
  const std::size_t since = h.index() < failures_.size() ? failures_[h.index()][static_cast<std::size_t>(pass)] : 0;
  if (since == 0 || changes_.size() - since > kMostChanges) return false;
  const EditMesh& mesh = front.mesh();
  const Vec3& from = mesh.position(mesh.origin(h));
  const Vec3& to = mesh.position(mesh.target(h));
  double length =
      std::max(front.sizeAt(mesh.vertex(mesh.origin(h)).location), front.sizeAt(mesh.vertex(mesh.target(h)).location));
  for (const HalfedgeId e : {front.previousFront(h), h, front.nextFront(h)}) {
    length = std::max(length, distance(mesh.position(mesh.origin(e)), mesh.position(mesh.target(e))));
  }
  const Vec3 middle = (from + to) * 0.5;
  return std::none_of(changes_.begin() + static_cast<std::ptrdiff_t>(since), changes_.end(), [&](const Change& change) {
    const double near = kReach * length + change.radius;
    return squaredNorm(change.centre - middle) <= near * near;
  });
}

}  // namespace qmcf
