#include "study_measures.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "qmcf/field/connection.hpp"

namespace qmcf {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

bool isEdgePin(FieldPin pin) {
  return pin == FieldPin::boundary || pin == FieldPin::sharp || pin == FieldPin::nonManifold;
}

/// Angle in degrees between a cross and one of its kind, both as fourth powers.
double crossDifference(std::complex<double> a, std::complex<double> b) {
  return std::fabs(std::arg(a * std::conj(b))) / 4.0 / kDegree;
}

double angleToCross(const std::array<Vec3, 4>& directions, const Vec3& along) {
  double best = 180.0;
  for (const Vec3& d : directions) {
    best = std::min(best, std::atan2(norm(cross(d, along)), dot(d, along)) / kDegree);
  }
  return best;
}

/// Whether two successive boundary half-edges are chords of the same edge of the B-rep, and meet at no corner.
bool insideEdge(const Patch& patch, HalfedgeId before, HalfedgeId after) {
  return patch.edge[before] != kNone && patch.edge[before] == patch.edge[after] &&
         patch.cornerQuads[patch.surface.origin(after)] == 2;
}

/// The direction between those of the chords before and after a node, in the plane of its frame.
Vec3 tangentAt(const Patch& patch, const TangentFrame& frame, HalfedgeId before, HalfedgeId after) {
  const Surface& surface = patch.surface;
  const auto direction = [&](HalfedgeId h) {
    return normalized(
        tangentPart(surface.position(surface.target(h)) - surface.position(surface.origin(h)), frame.normal));
  };
  return normalized(direction(before) + direction(after));
}

std::array<Vec3, 4> directionsAt(const CrossField& field, VertexId v) {
  const double angle = std::arg(field.cross[v]) / 4.0;
  const Vec3 first = field.frame[v].x * std::cos(angle) + field.frame[v].y * std::sin(angle);
  const Vec3 second = cross(field.frame[v].normal, first);
  return {first, second, first * -1.0, second * -1.0};
}

double edgeEnergy(const Patch& patch, const CrossField& field) {
  const Surface& surface = patch.surface;
  const Connection connection = buildConnection(patch);
  double sum = 0.0;
  for (const HalfedgeId h : surface.halfedges()) {
    const HalfedgeId back = surface.twin(h);
    if (back.valid() && back < h) continue;
    const std::complex<double> moved = field.cross[surface.origin(h)] * transportCross(surface, connection, h);
    const double turn = std::arg(field.cross[surface.target(h)] * std::conj(moved)) / 4.0;
    sum += turn * turn;
  }
  return sum;
}

std::int64_t countNotFinite(const Patch& patch, const CrossField& field) {
  std::int64_t count = 0;
  for (const auto& u : field.cross.raw()) count += std::fabs(std::abs(u) - 1.0) < 1e-9 ? 0 : 1;
  for (const auto& corners : field.corner.raw()) {
    for (const auto& u : corners) count += std::fabs(std::abs(u) - 1.0) < 1e-9 ? 0 : 1;
  }
  for (const Singularity& s : field.singularities) {
    count += std::isfinite(norm(positionOf(patch.surface, s.point))) ? 0 : 1;
  }
  return count + (std::isfinite(field.energy) ? 0 : 1);
}

std::int64_t countNearBoundary(const Patch& patch, const CrossField& field) {
  std::int64_t count = 0;
  for (const Singularity& s : field.singularities) {
    const Vec3 p = positionOf(patch.surface, s.point);
    double nearest = std::numeric_limits<double>::infinity();
    for (const VertexId v : patch.surface.vertices()) {
      if (!patch.surface.isBoundary(v)) continue;
      nearest = std::min(nearest, distance(p, patch.surface.position(v)) / patch.size[v]);
    }
    if (nearest < 1.0) ++count;
  }
  return count;
}

}  // namespace

void FieldFigures::add(const FieldFigures& other) {
  vertices += other.vertices;
  positive += other.positive;
  negative += other.negative;
  pairs += other.pairs;
  nearBoundary += other.nearBoundary;
  indexDefect += std::abs(other.indexDefect);
  notFinite += other.notFinite;
  pinned += other.pinned;
  removed += other.removed;
  energy += other.energy;
  boundaryDeviation = std::max(boundaryDeviation, other.boundaryDeviation);
  curvatureDeviation += other.curvatureDeviation;
  reliable += other.reliable;
}

double boundaryDeviation(const Patch& patch, const CrossField& field) {
  const Surface& surface = patch.surface;
  const Connection connection = buildConnection(patch);
  IdMap<VertexId, HalfedgeId> arriving(surface.vertexCount());
  for (const HalfedgeId h : surface.halfedges()) {
    if (surface.isBoundary(h)) arriving[surface.target(h)] = h;
  }
  double worst = 0.0;
  for (const HalfedgeId h : surface.halfedges()) {
    const VertexId a = surface.origin(h);
    const VertexId b = surface.target(h);
    if (!surface.isBoundary(h) || !isEdgePin(field.constrained[a]) || !isEdgePin(field.constrained[b])) continue;
    worst = std::max(worst, crossDifference(field.cross[a], std::polar(1.0, 4.0 * connection.angle[h])));
    worst = std::max(worst, crossDifference(field.cross[b], std::polar(1.0, 4.0 * connection.total[b])));
    if (insideEdge(patch, arriving[a], h)) {
      worst = std::max(worst, angleToCross(directionsAt(field, a), tangentAt(patch, field.frame[a], arriving[a], h)));
    }
    if (surface.isBoundary(Surface::next(h)) || surface.isBoundary(Surface::prev(h))) continue;
    // Between the nodes the tangent turns evenly; a corner has none, there it is the chord.
    const HalfedgeId next = surface.outgoing(b);
    const double atA = insideEdge(patch, arriving[a], h) ? 0.5 * (connection.fan[a] - std::numbers::pi) : 0.0;
    const double atB = insideEdge(patch, h, next) ? 0.5 * (std::numbers::pi - connection.fan[b]) : 0.0;
    SurfacePoint middle{Surface::triangle(h), {0.0, 0.0, 0.0}};
    middle.barycentric[static_cast<std::size_t>(h.value % 3)] = 0.5;
    middle.barycentric[static_cast<std::size_t>(Surface::next(h).value % 3)] = 0.5;
    const Vec3 chord = normalized(surface.position(b) - surface.position(a));
    const Vec3 left = cross(normalized(surface.areaVector(Surface::triangle(h))), chord);
    const double turn = 0.5 * (atA + atB);
    worst = std::max(
        worst, angleToCross(crossDirections(surface, field, middle), chord * std::cos(turn) + left * std::sin(turn)));
  }
  return worst;
}

FieldFigures measureField(const Patch& patch, const CrossField& field, const CrossField& reliable) {
  FieldFigures figures;
  figures.vertices = static_cast<std::int64_t>(patch.surface.vertexCount());
  std::int64_t all = 0;
  std::int64_t sum = 0;
  for (const Singularity& s : field.singularities) {
    ++(s.index > 0 ? figures.positive : figures.negative);
    all += std::abs(s.index);
    sum += s.index;
  }
  figures.pairs = (all - std::abs(sum)) / 2;
  figures.nearBoundary = countNearBoundary(patch, field);
  figures.indexDefect = gaussBonnetDefect(patch, field);
  figures.notFinite = countNotFinite(patch, field);
  figures.energy = edgeEnergy(patch, field);
  figures.boundaryDeviation = boundaryDeviation(patch, field);
  for (const VertexId v : patch.surface.vertices()) {
    if (field.constrained[v] != FieldPin::none) ++figures.pinned;
    figures.removed += field.removed[v];
    if (reliable.constrained[v] != FieldPin::curvature) continue;
    ++figures.reliable;
    figures.curvatureDeviation += crossDifference(field.cross[v], reliable.cross[v]);
  }
  return figures;
}

}  // namespace qmcf
