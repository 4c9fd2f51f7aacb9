#include "qmcf/sizing/slits.hpp"

#include <algorithm>
#include <cstddef>

#include "qmcf/base/bounding_box.hpp"

namespace qmcf {
namespace {

/// Cosine of the angle between the sides of a slit at a vertex that they share.
constexpr double kSameDirection = 0.999;

/// A boundary edge and the box around it.
struct BoxedEdge {
  std::int32_t edge = kNone;
  BoundingBox box;
};

/// Where an edge leads from its start or its end.
Vec3 directionFrom(const EdgeCurve& curve, bool end) {
  const std::vector<Vec3>& p = curve.points;
  return end ? normalized(p[p.size() - 2] - p.back()) : normalized(p[1] - p[0]);
}

/// Whether two edges have no vertex in common, or leave one in almost the same direction. Others go apart there.
bool mayRunTogether(const Brep& brep, const std::vector<EdgeCurve>& curves, std::int32_t one, std::int32_t other) {
  const auto a = static_cast<std::size_t>(one);
  const auto b = static_cast<std::size_t>(other);
  bool shareVertex = false;
  for (const bool atEnd : {false, true}) {
    for (const bool otherAtEnd : {false, true}) {
      const std::int32_t vertex = atEnd ? brep.edges[a].end : brep.edges[a].start;
      if (vertex != (otherAtEnd ? brep.edges[b].end : brep.edges[b].start)) continue;
      shareVertex = true;
      if (dot(directionFrom(curves[a], atEnd), directionFrom(curves[b], otherAtEnd)) >= kSameDirection) return true;
    }
  }
  return !shareVertex;
}

}  // namespace

std::vector<std::array<std::int32_t, 2>> findSlits(const Brep& brep, const std::vector<EdgeCurve>& curves,
                                                   double width) {
  std::vector<BoxedEdge> boxed;
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    if (brep.edges[e].kind != EdgeKind::boundary) continue;
    BoundingBox& box = boxed.emplace_back(BoxedEdge{static_cast<std::int32_t>(e), {}}).box;
    for (const Vec3& p : curves[e].points) box.include(p);
    box.widen(width);
  }
  std::sort(boxed.begin(), boxed.end(), [](const BoxedEdge& a, const BoxedEdge& b) {
    return a.box.low.x != b.box.low.x ? a.box.low.x < b.box.low.x : a.edge < b.edge;
  });
  std::vector<std::array<std::int32_t, 2>> slits;
  for (std::size_t i = 0; i < boxed.size(); ++i) {
    for (std::size_t j = i + 1; j < boxed.size() && boxed[j].box.low.x <= boxed[i].box.high.x; ++j) {
      const auto [one, other] = std::minmax(boxed[i].edge, boxed[j].edge);
      if (boxed[i].box.meets(boxed[j].box) && mayRunTogether(brep, curves, one, other)) slits.push_back({one, other});
    }
  }
  std::sort(slits.begin(), slits.end());
  return slits;
}

double slitWidth(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) return 0.0;
  BoundingBox box;
  for (const Vec3& p : mesh.positions) box.include(p);
  return 1e-5 * box.diagonal();
}

std::optional<double> acrossSlit(const EdgeCurve& curve, const Vec3& point, double width) {
  double least = width * width;
  std::optional<double> nearest;
  for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
    const Vec3 along = curve.points[i + 1] - curve.points[i];
    const double length = squaredNorm(along);
    const double t = length > 0.0 ? std::clamp(dot(point - curve.points[i], along) / length, 0.0, 1.0) : 0.0;
    const double square = squaredNorm(curve.points[i] + along * t - point);
    if (square > least) continue;
    least = square;
    nearest = curve.arcLength[i] + t * (curve.arcLength[i + 1] - curve.arcLength[i]);
  }
  if (nearest && (*nearest <= width || *nearest >= curve.length() - width)) return std::nullopt;
  return nearest;
}

}  // namespace qmcf
