#include "qmcf/spatial/surface_walk.hpp"

#include <algorithm>

namespace qmcf {
namespace {

constexpr int kMaxSteps = 1000;

double clamp01(double t) { return std::clamp(t, 0.0, 1.0); }

/// Parameter in [0, 1] of the point of segment ab closest to p.
double closestOnSegment(const Vec3& a, const Vec3& b, const Vec3& p) {
  const double length2 = squaredNorm(b - a);
  return length2 > 0.0 ? clamp01(dot(p - a, b - a) / length2) : 0.0;
}

}  // namespace

SurfacePoint closestOnTriangle(const Surface& surface, TriangleId triangle, const Vec3& query) {
  const auto corners = surface.corners(triangle);
  const std::array<Vec3, 3> p{surface.position(corners[0]), surface.position(corners[1]), surface.position(corners[2])};
  const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
  const double area2 = squaredNorm(normal);
  if (area2 > 0.0) {
    std::array<double, 3> b{};
    for (std::size_t i = 0; i < 3; ++i) {
      b[i] = dot(cross(p[(i + 2) % 3] - p[(i + 1) % 3], query - p[(i + 1) % 3]), normal) / area2;
    }
    if (b[0] >= 0.0 && b[1] >= 0.0 && b[2] >= 0.0) {
      const double sum = b[0] + b[1] + b[2];
      return {triangle, {b[0] / sum, b[1] / sum, b[2] / sum}};
    }
  }
  SurfacePoint best{triangle, {1.0, 0.0, 0.0}};
  double bestDistance = squaredNorm(query - p[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double t = closestOnSegment(p[i], p[j], query);
    const double d = squaredNorm(query - (p[i] * (1.0 - t) + p[j] * t));
    if (d < bestDistance) {
      bestDistance = d;
      best.barycentric = {0.0, 0.0, 0.0};
      best.barycentric[i] = 1.0 - t;
      best.barycentric[j] = t;
    }
  }
  return best;
}

SurfacePoint walkToClosest(const Surface& surface, TriangleId start, const Vec3& query) {
  SurfacePoint best = closestOnTriangle(surface, start, query);
  double bestDistance = squaredNorm(query - positionOf(surface, best));
  for (int step = 0; step < kMaxSteps; ++step) {
    const TriangleId from = best.triangle;
    // Inside a triangle nothing closer is near; otherwise look at all triangles around the corners that carry the
    // point.
    for (int corner = 0; corner < 3; ++corner) {
      const auto weights = best.barycentric;
      if (best.triangle != from) break;
      if (weights[static_cast<std::size_t>(corner)] <= 0.0) continue;
      if (weights[0] > 0.0 && weights[1] > 0.0 && weights[2] > 0.0) break;
      SurfacePoint candidateBest = best;
      surface.forEachOutgoing(surface.origin(Surface::halfedge(from, corner)), [&](HalfedgeId h) {
        const TriangleId t = Surface::triangle(h);
        if (t == from) return;
        const SurfacePoint candidate = closestOnTriangle(surface, t, query);
        const double d = squaredNorm(query - positionOf(surface, candidate));
        if (d < bestDistance) {
          bestDistance = d;
          candidateBest = candidate;
        }
      });
      best = candidateBest;
    }
    if (best.triangle == from) break;
  }
  return best;
}

}  // namespace qmcf
