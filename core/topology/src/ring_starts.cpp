#include "ring_starts.hpp"

#include <cstddef>
#include <limits>

namespace qmcf::detail {
namespace {

class StartPlacement {
 public:
  StartPlacement(const TriangleMesh& mesh, const std::vector<Ring>& rings, const std::vector<std::uint8_t>& hasVertices)
      : mesh_(mesh), rings_(rings), hasVertices_(hasVertices), ringsOf_(hasVertices.size()), start_(rings.size()) {
    for (std::size_t r = 0; r < rings.size(); ++r) {
      for (const std::int32_t face : rings[r].faces) ringsOf_[static_cast<std::size_t>(face)].push_back(r);
    }
  }

  std::vector<VertexId> place() {
    for (std::size_t r = rings_.size(); r-- > 0;) {
      if (start_[r].valid()) continue;
      begin(r, rings_[r].points.front());
      passOn();
    }
    return start_;
  }

 private:
  [[nodiscard]] const Vec3& at(VertexId v) const { return mesh_.positions[v.index()]; }

  void begin(std::size_t ring, VertexId start) {
    start_[ring] = start;
    open_.push_back(ring);
  }

  [[nodiscard]] VertexId nearestTo(std::size_t ring, VertexId v) const {
    VertexId nearest = rings_[ring].points.front();
    double least = std::numeric_limits<double>::infinity();
    for (const VertexId point : rings_[ring].points) {
      const double distance = squaredNorm(at(point) - at(v));
      if (!(distance < least)) continue;
      least = distance;
      nearest = point;
    }
    return nearest;
  }

  /// From rings that have a start to those across from them.
  void passOn() {
    while (!open_.empty()) {
      const std::size_t ring = open_.back();
      open_.pop_back();
      for (const std::int32_t face : rings_[ring].faces) {
        const auto f = static_cast<std::size_t>(face);
        if (ringsOf_[f].size() != 2 || hasVertices_[f] != 0) continue;
        const std::size_t other = ringsOf_[f][ringsOf_[f][0] == ring ? 1 : 0];
        if (!start_[other].valid()) begin(other, nearestTo(other, start_[ring]));
      }
    }
  }

  const TriangleMesh& mesh_;
  const std::vector<Ring>& rings_;
  const std::vector<std::uint8_t>& hasVertices_;
  std::vector<std::vector<std::size_t>> ringsOf_;  ///< Per face.
  std::vector<VertexId> start_;                    ///< Per ring; invalid: not known yet.
  std::vector<std::size_t> open_;                  ///< Rings whose start has not been passed on.
};

}  // namespace

std::vector<VertexId> placeRingStarts(const TriangleMesh& mesh, const std::vector<Ring>& rings,
                                      const std::vector<std::uint8_t>& hasVertices) {
  return StartPlacement(mesh, rings, hasVertices).place();
}

}  // namespace qmcf::detail
