// How far it is across a face: a straight geodesic is shot from an edge into the face, at a right angle to the edge,
// through the unfolded triangles.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "edge_samples.hpp"
#include "qmcf/base/vec.hpp"

namespace qmcf {
namespace {

/// A point on a half-edge; fraction from its origin to its target.
struct EdgePoint {
  HalfedgeId halfedge;
  double fraction = 0.0;
};

struct Hit {
  EdgePoint point;
  double distance = 0.0;
};

/// Walks straight from a boundary point into the surface until the boundary, at most maxDistance.
std::optional<Hit> shootAcross(const Surface& surface, EdgePoint from, double maxDistance) {
  constexpr int kMaxSteps = 20000;
  Vec2 direction{0.0, 1.0};
  double walked = 0.0;
  for (int step = 0; step < kMaxSteps; ++step) {
    // The frame of the triangle: x along the half-edge of entry, the triangle above.
    const HalfedgeId h = from.halfedge;
    const Vec3 a = surface.position(surface.origin(h));
    const Vec3 along = surface.position(surface.target(h)) - a;
    const Vec3 toApex = surface.position(surface.opposite(h)) - a;
    const double length = norm(along);
    if (!(length > 0.0)) return std::nullopt;
    const Vec3 x = along / length;
    const Vec2 b{length, 0.0};
    const Vec2 c{dot(toApex, x), norm(tangentPart(toApex, x))};
    const Vec2 p{length * from.fraction, 0.0};
    const bool passesRightOfApex = cross(direction, c - p) > 0.0;
    const HalfedgeId out = passesRightOfApex ? Surface::next(h) : Surface::prev(h);
    const Vec2 start = passesRightOfApex ? b : c;
    const Vec2 end = passesRightOfApex ? c : Vec2{};
    const Vec2 side = end - start;
    const double sideLength = norm(side);
    const double determinant = cross(direction, side);
    if (!(sideLength > 0.0) || !(std::fabs(determinant) > 0.0)) return std::nullopt;
    const double fraction = std::clamp(cross(start - p, direction) / determinant, 0.0, 1.0);
    walked += norm(start + side * fraction - p);
    if (walked > maxDistance) return std::nullopt;
    if (surface.isBoundary(out)) return Hit{{out, fraction}, walked};
    const Vec2 back = side * (-1.0 / sideLength);
    direction = {dot(direction, back), cross(back, direction)};
    from = {surface.twin(out), 1.0 - fraction};
  }
  return std::nullopt;
}

/// Where a boundary half-edge of a face lies on the edges of the B-rep and in its loop.
struct BoundaryPlace {
  std::int32_t edge = kNone;
  double start = 0.0;      ///< Arc length of the edge at the half-edge's origin.
  double end = 0.0;        ///< Arc length of the edge at its target.
  double alongLoop = 0.0;  ///< Length of the loop up to its origin.
  std::int32_t loop = kNone;
};

struct FaceBoundary {
  IdMap<HalfedgeId, BoundaryPlace> place;
  std::vector<double> loopLength;
};

FaceBoundary boundaryOf(const BrepFace& face, const FaceSurface& cut, const std::vector<EdgeCurve>& curves) {
  FaceBoundary boundary;
  boundary.place.resize(cut.surface.halfedgeCount());
  for (std::size_t l = 0; l < cut.loops.size(); ++l) {
    double sum = 0.0;
    std::size_t next = 0;
    for (std::size_t c = 0; c < face.loops[l].coedges.size(); ++c) {
      const Coedge& coedge = face.loops[l].coedges[c];
      const EdgeCurve& curve = curves[static_cast<std::size_t>(coedge.edge)];
      const std::size_t segments = curve.points.size() - 1;
      for (std::size_t i = 0; i < segments && next < cut.loops[l].size(); ++i, ++next) {
        const std::size_t from = coedge.reversed ? segments - i : i;
        const std::size_t to = coedge.reversed ? from - 1 : from + 1;
        BoundaryPlace& place = boundary.place[cut.loops[l][next]];
        place = {coedge.edge, curve.arcLength[from], curve.arcLength[to], sum, static_cast<std::int32_t>(l)};
        sum += std::fabs(place.end - place.start);
      }
    }
    boundary.loopLength.push_back(sum);
  }
  return boundary;
}

double along(const BoundaryPlace& place, double fraction) { return place.start + (place.end - place.start) * fraction; }

/// The shorter way along a loop between two places, if they are on one loop at all.
double wayAround(const FaceBoundary& boundary, const BoundaryPlace& from, double fromFraction, const BoundaryPlace& to,
                 const Hit& hit) {
  if (from.loop != to.loop) return std::numeric_limits<double>::infinity();
  const double here = from.alongLoop + std::fabs(from.end - from.start) * fromFraction;
  const double there = to.alongLoop + std::fabs(to.end - to.start) * hit.point.fraction;
  const double apart = std::fabs(there - here);
  return std::min(apart, boundary.loopLength[static_cast<std::size_t>(from.loop)] - apart);
}

/// Shoots from the places on the half-edge that are odd multiples of half a step along its edge.
void shootFromHalfedge(std::vector<Gap>& gaps, const Surface& surface, const FaceBoundary& boundary, HalfedgeId h,
                       double step, double reach) {
  constexpr double kDetour = 3.0;
  const BoundaryPlace& place = boundary.place[h];
  const double first = std::min(place.start, place.end);
  const double last = std::max(place.start, place.end);
  for (double k = std::ceil(first / step - 0.5); (k + 0.5) * step < last; k += 1.0) {
    const double s = (k + 0.5) * step;
    const double fraction = std::clamp((s - place.start) / (place.end - place.start), 0.0, 1.0);
    const std::optional<Hit> hit = shootAcross(surface, {h, fraction}, reach);
    if (!hit) continue;
    const BoundaryPlace& other = boundary.place[hit->point.halfedge];
    if (other.edge == kNone) continue;
    // Merely the other leg of a nearby corner or bend.
    if (wayAround(boundary, place, fraction, other, *hit) <= kDetour * hit->distance) continue;
    Gap& gap = gaps.emplace_back();
    gap.edge = {place.edge, other.edge};
    gap.arcLength = {s, along(other, hit->point.fraction)};
    gap.distance = hit->distance;
  }
}

}  // namespace

std::optional<std::vector<Gap>> findGaps(const std::vector<EdgeCurve>& curves, const Brep& brep, double reach,
                                         double spacing, Progress& progress) {
  std::vector<Gap> gaps;
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    const double done = static_cast<double>(f) / static_cast<double>(brep.faces.size());
    if (!progress.report(Stage::sizing, 0.3 + 0.7 * done)) return std::nullopt;
    const BrepFace& face = brep.faces[f];
    if (face.loops.empty()) continue;
    const FaceSurface& cut = brep.cuts[f];
    const FaceBoundary boundary = boundaryOf(face, cut, curves);
    for (const auto& loop : cut.loops) {
      for (const HalfedgeId h : loop) {
        const std::int32_t edge = boundary.place[h].edge;
        if (edge == kNone) continue;
        const double length = curves[static_cast<std::size_t>(edge)].length();
        if (!(length > 0.0)) continue;
        shootFromHalfedge(gaps, cut.surface, boundary, h, length / std::ceil(length / spacing), reach);
      }
    }
  }
  return gaps;
}

}  // namespace qmcf
