#include "failed_attempts.hpp"

#include <limits>

namespace qmcf {
namespace {

/// How far an attempt looks, in element sizes or lengths of the front's edges, whichever are longer: a walk of 2.6
/// sizes, front nodes within 2 of a side edge's end, loops of up to six edges.
constexpr double kReach = 5.0;
/// With more changes than this since the failure, one of them is near.
constexpr std::size_t kMostChanges = 2000;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

void FailedAttempts::noteChange(const EditMesh& mesh) {
  // The ball around a box is larger than it need be, but much is visited often: no points are kept for a better one.
  Vec3 low{kInfinity, kInfinity, kInfinity};
  Vec3 high = -low;
  const auto include = [&](const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  };
  FaceId last;
  const auto includeFace = [&](FaceId f) {
    if (f == last || mesh.kind(f) == FaceKind::removed) return;
    last = f;
    for (const HalfedgeId h : mesh.sides(f)) {
      if (h.valid()) include(mesh.position(mesh.origin(h)));
    }
  };
  const auto includeAround = [&](VertexId v) {
    if (!mesh.alive(v)) return;
    mesh.forEachOutgoing(v, [&](HalfedgeId h) { include(mesh.position(mesh.target(h))); });
  };
  mesh.forEachChange(includeFace, includeAround);
  Change change;
  if (low.x <= high.x) change = {(low + high) * 0.5, 0.5 * distance(low, high)};
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
