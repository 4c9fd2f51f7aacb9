#include "qmcf/field/streamline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

using Plane = std::complex<double>;

constexpr double kInside = 1e-9;   // how far from its corners a curve crosses an edge, as a part of the edge
constexpr double kGrazing = 1e-3;  // least slope with which a curve leaves the edge that it came through

double dotOf(Plane a, Plane b) { return a.real() * b.real() + a.imag() * b.imag(); }
double crossOf(Plane a, Plane b) { return a.real() * b.imag() - a.imag() * b.real(); }

/// A triangle laid into the plane of its own frame.
struct FlatTriangle {
  std::array<Plane, 3> corner;

  FlatTriangle(const Surface& surface, TriangleId t) {
    const auto corners = surface.corners(t);
    const Vec3 a = surface.position(corners[1]) - surface.position(corners[0]);
    const Vec3 b = surface.position(corners[2]) - surface.position(corners[0]);
    const double length = norm(a);
    const double along = length > 0.0 ? dot(a, b) / length : 0.0;
    corner = {Plane(0.0), Plane(length), Plane(along, std::sqrt(std::fmax(0.0, squaredNorm(b) - along * along)))};
  }
  [[nodiscard]] Plane at(const SurfacePoint& p) const {
    return corner[0] * p.barycentric[0] + corner[1] * p.barycentric[1] + corner[2] * p.barycentric[2];
  }
  [[nodiscard]] Plane side(int c) const {
    return corner[static_cast<std::size_t>((c + 1) % 3)] - corner[static_cast<std::size_t>(c)];
  }
};

struct Exit {
  int side = 0;
  double share = 0.0;  ///< Of the side, from its first corner.
  double distance = 0.0;
};

/// Where the ray leaves the triangle; not through the side that it entered by.
std::optional<Exit> leave(const FlatTriangle& flat, Plane from, Plane direction, int entry) {
  std::optional<Exit> best;
  for (int c = 0; c < 3; ++c) {
    const Plane side = flat.side(c);
    const double outwards = -crossOf(side, direction);
    if (c == entry || !(outwards > 0.0)) continue;
    const Plane offset = from - flat.corner[static_cast<std::size_t>(c)];
    const double distance = std::fmax(0.0, crossOf(side, offset) / outwards);
    const double share = dotOf(offset + direction * distance, side) / std::norm(side);
    if (!best || distance < best->distance) best = Exit{c, std::clamp(share, kInside, 1.0 - kInside), distance};
  }
  return best;
}

SurfacePoint onSide(TriangleId t, int side, double share) {
  SurfacePoint point{t, {0.0, 0.0, 0.0}};
  point.barycentric[static_cast<std::size_t>(side)] = 1.0 - share;
  point.barycentric[static_cast<std::size_t>((side + 1) % 3)] = share;
  return point;
}

/// The branch of the field closest to the heading, turned inwards where it points back through the side of entry.
Plane branch(const CrossField& field, const FlatTriangle& flat, const SurfacePoint& point, Plane heading, int entry) {
  Plane best = math::unitComplex(crossAngle(field, point));
  const std::array<Plane, 4> quarter{Plane(1.0, 0.0), Plane(0.0, 1.0), Plane(-1.0, 0.0), Plane(0.0, -1.0)};
  const Plane first = best;
  for (const Plane q : quarter) {
    if (dotOf(first * q, heading) > dotOf(best, heading)) best = first * q;
  }
  if (entry >= 0) {
    const Plane side = math::normalized(flat.side(entry));
    if (crossOf(side, best) < kGrazing) {
      best = math::normalized(side * (dotOf(side, best) < 0.0 ? -1.0 : 1.0) + Plane(0.0, kGrazing) * side);
    }
  }
  return best;
}

SurfacePoint middle(const SurfacePoint& a, const SurfacePoint& b) {
  SurfacePoint m = a;
  for (std::size_t c = 0; c < 3; ++c) m.barycentric[c] = 0.5 * (a.barycentric[c] + b.barycentric[c]);
  return m;
}

/// A point strictly inside its triangle, so that the first ray has a side to leave by.
SurfacePoint nudged(SurfacePoint point) {
  double sum = 0.0;
  for (double& b : point.barycentric) sum += b = std::max(b, kInside);
  for (double& b : point.barycentric) b /= sum;
  return point;
}

Plane flatDirection(const Surface& surface, TriangleId t, const Vec3& direction) {
  const auto corners = surface.corners(t);
  const Vec3 x = normalized(surface.position(corners[1]) - surface.position(corners[0]));
  const Vec3 y = cross(normalized(surface.areaVector(t)), x);
  return math::normalized({dot(direction, x), dot(direction, y)});
}

}  // namespace

Streamline traceStreamline(const Surface& surface, const CrossField& field, const SurfacePoint& start,
                           const Vec3& direction, const StreamlineOptions& options) {
  Streamline line;
  line.points.push_back(start);
  SurfacePoint point = nudged(start);
  Plane heading = flatDirection(surface, point.triangle, direction);
  int entry = -1;
  for (std::int32_t step = 0; step < options.steps; ++step) {
    if (crossConfidence(field, point) < options.leastConfidence) {
      line.end = StreamlineEnd::singularity;
      return line;
    }
    const FlatTriangle flat(surface, point.triangle);
    heading = branch(field, flat, point, heading, entry);
    std::optional<Exit> exit = leave(flat, flat.at(point), heading, entry);
    if (!exit) break;
    heading = branch(field, flat, middle(point, onSide(point.triangle, exit->side, exit->share)), heading, entry);
    exit = leave(flat, flat.at(point), heading, entry);
    if (!exit) break;
    SurfacePoint next = onSide(point.triangle, exit->side, exit->share);
    const double distance = std::sqrt(std::norm(flat.at(next) - flat.at(point)));
    if (line.length + distance >= options.length) {
      const double share = distance > 0.0 ? (options.length - line.length) / distance : 0.0;
      for (std::size_t c = 0; c < 3; ++c) {
        next.barycentric[c] = (1.0 - share) * point.barycentric[c] + share * next.barycentric[c];
      }
      line.points.push_back(next);
      line.length = options.length;
      line.end = StreamlineEnd::length;
      return line;
    }
    line.points.push_back(next);
    line.length += distance;
    const HalfedgeId back = surface.twin(Surface::halfedge(point.triangle, exit->side));
    if (!back.valid()) {
      line.end = StreamlineEnd::boundary;
      return line;
    }
    // The heading keeps its angle to the edge that it crosses.
    const Plane relative = heading / math::normalized(flat.side(exit->side));
    entry = back.value % 3;
    point = onSide(Surface::triangle(back), entry, 1.0 - exit->share);
    heading = -relative * math::normalized(FlatTriangle(surface, point.triangle).side(entry));
  }
  line.end = StreamlineEnd::steps;
  return line;
}

}  // namespace qmcf
