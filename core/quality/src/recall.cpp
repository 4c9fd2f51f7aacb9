#include <algorithm>
#include <cmath>

#include "fidelity.hpp"
#include "qmcf/base/math.hpp"

namespace qmcf::quality {
namespace {

constexpr double kReach = 0.1;          ///< Of the size.
constexpr double kPiece = 0.25;         ///< Of the size: longest piece of a feature edge.
constexpr double kCell = 2.0;           ///< Of the size: cells of the grid over the mesh's edges.
constexpr double kLargestAngle = 25.0;  ///< Degrees: an arc in eight divisions turns its chords by up to 22.5.
/// Bounds the work where the size is tiny against the features.
constexpr double kMostPieces = 1e6;

SegmentGrid gridOfEdges(const MeasuredMesh& measured, double size) {
  std::vector<Segment> segments;
  segments.reserve(measured.structure.edges.edges.size());
  for (const EdgeRecord& edge : measured.structure.edges.edges) {
    segments.push_back({measured.mesh.positions[static_cast<std::size_t>(edge.low)],
                        measured.mesh.positions[static_cast<std::size_t>(edge.high)]});
  }
  return {std::move(segments), kCell * size, kReach * size};
}

std::optional<double> recallOf(const std::vector<Segment>& features, const SegmentGrid& grid, double size) {
  const double cosine = math::cos(kLargestAngle * math::kPi / 180.0);
  double total = 0.0;
  for (const Segment& feature : features) total += distance(feature[0], feature[1]);
  if (!(total > 0.0)) return std::nullopt;
  const double longest = std::max(kPiece * size, total / kMostPieces);
  double kept = 0.0;
  for (const Segment& feature : features) {
    const Vec3 along = feature[1] - feature[0];
    const double length = norm(along);
    if (!(length > 0.0)) continue;
    const double pieces = std::max(1.0, std::ceil(length / longest));
    const auto isParallel = [&](std::uint32_t, const Segment& edge) {
      const Vec3 direction = edge[1] - edge[0];
      return std::fabs(dot(direction, along)) > cosine * norm(direction) * length;
    };
    for (double piece = 0.5; piece < pieces; piece += 1.0) {
      const Vec3 middle = feature[0] + along * (piece / pieces);
      if (grid.anyWithin(middle, kReach * size, isParallel)) kept += length / pieces;
    }
  }
  return std::min(1.0, kept / total);
}

std::optional<double> recallOfCorners(const MeasuredMesh& measured, const std::vector<Vec3>& corners, double size) {
  if (corners.empty()) return std::nullopt;
  // There are few corners: the vertices look for them rather than the other way round.
  std::vector<Segment> points;
  for (const Vec3& corner : corners) points.push_back({corner, corner});
  const SegmentGrid grid(std::move(points), size, kReach * size);
  std::vector<std::uint8_t> kept(corners.size(), 0);
  for (std::size_t v = 0; v < measured.mesh.positions.size(); ++v) {
    if (measured.structure.elementsAround[v] == 0) continue;
    grid.anyWithin(measured.mesh.positions[v], kReach * size, [&](std::uint32_t corner, const Segment&) {
      kept[corner] = 1;
      return false;
    });
  }
  return static_cast<double>(std::count(kept.begin(), kept.end(), 1)) / static_cast<double>(corners.size());
}

}  // namespace

Recall measureRecall(const MeasuredMesh& measured, const ReferenceFeatures& features, double size) {
  const SegmentGrid grid = gridOfEdges(measured, size);
  return {recallOf(features.sharp, grid, size), recallOf(features.boundary, grid, size),
          recallOf(features.nonManifold, grid, size), recallOfCorners(measured, features.corners, size)};
}

}  // namespace qmcf::quality
