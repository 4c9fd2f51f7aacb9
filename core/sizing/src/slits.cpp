#include "qmcf/sizing/slits.hpp"

#include <algorithm>
#include <cstddef>

namespace qmcf {
namespace {

/// Cosine of the angle between the sides of a slit at a vertex that they share.
constexpr double kSameDirection = 0.999;

/// A boundary edge and the box around it.
struct BoxedEdge {
  std::int32_t edge = kNone;
  Vec3 low;
  Vec3 high;
};

BoxedEdge boxed(std::int32_t edge, const EdgeCurve& curve, double margin) {
  const Vec3 around{margin, margin, margin};
  BoxedEdge box{edge, curve.points.front(), curve.points.front()};
  for (const Vec3& p : curve.points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  box.low = box.low - around;
  box.high = box.high + around;
  return box;
}

bool overlap(const BoxedEdge& a, const BoxedEdge& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

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
  std::vector<BoxedEdge> boxes;
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    if (brep.edges[e].kind == EdgeKind::boundary)
      boxes.push_back(boxed(static_cast<std::int32_t>(e), curves[e], width));
  }
  std::sort(boxes.begin(), boxes.end(), [](const BoxedEdge& a, const BoxedEdge& b) {
    return a.low.x != b.low.x ? a.low.x < b.low.x : a.edge < b.edge;
  });
  std::vector<std::array<std::int32_t, 2>> slits;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].low.x <= boxes[i].high.x; ++j) {
      const auto [one, other] = std::minmax(boxes[i].edge, boxes[j].edge);
      if (overlap(boxes[i], boxes[j]) && mayRunTogether(brep, curves, one, other)) slits.push_back({one, other});
    }
  }
  std::sort(slits.begin(), slits.end());
  return slits;
}

double slitWidth(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) return 0.0;
  Vec3 low = mesh.positions.front();
  Vec3 high = low;
  for (const Vec3& p : mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return 1e-5 * distance(low, high);
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
