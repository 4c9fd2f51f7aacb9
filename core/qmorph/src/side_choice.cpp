// Side edge definition: step 4a of section 4.1 (Owen et al. 1999).
#include "side_choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "qmcf/base/math.hpp"
#include "qmcf/front/recovery.hpp"

namespace qmcf {
namespace {

/// A node on the front closes it, which is worth a larger deviation from the bisector.
constexpr double kClosingFactor = 1.5;
/// A swapped edge may be this long in units of the mean of the two front edges: sqrt(3), as in equilateral triangles.
constexpr double kLongestSwap = 1.7320508075688772;
/// A split this near to the end of an edge, as a fraction, would make a needle.
constexpr double kNearestSplit = 0.12;
/// A split that makes a side edge shorter than this, in units of the mean of the two front edges, would only be the
/// first of many.
constexpr double kShortestSide = 0.3;

/// An edge between the two front edges, and its angle from the first.
struct Spoke {
  HalfedgeId edge;
  double angle = 0.0;
};

/// The triangles at the origin of a front edge, unfolded.
struct Fan {
  std::vector<Spoke> spokes;  ///< All but the two front edges, counter-clockwise.
  double angle = 0.0;         ///< Between the front edges.
  HalfedgeId pierced;         ///< Spoke, or first front edge, before the triangle that the bisector runs through.
  double piercedAngle = 0.0;  ///< Its angle from the first front edge.
};

Fan fanOf(const MorphMesh& morph, HalfedgeId sector) {
  const EditMesh& mesh = morph.mesh();
  Fan fan;
  fan.angle = morph.front().sectorAngle(sector);
  double angle = 0.0;
  HalfedgeId h = sector;
  for (;;) {
    const double corner = cornerAngleOf(mesh, h);
    if (!fan.pierced.valid() && angle + corner >= 0.5 * fan.angle) {
      fan.pierced = h;
      fan.piercedAngle = angle;
    }
    angle += corner;
    const HalfedgeId back = mesh.prev(h);
    if (morph.front().isFront(back)) break;
    h = mesh.twin(back);
    fan.spokes.push_back({h, angle});
  }
  return fan;
}

/// Where the bisector meets the far edge of the pierced triangle, as a fraction of that edge.
double crossingOf(const EditMesh& mesh, const Fan& fan) {
  const Vec3 p = mesh.position(mesh.origin(fan.pierced));
  const Vec3 u = mesh.position(mesh.target(fan.pierced)) - p;
  const Vec3 v = mesh.position(mesh.origin(mesh.prev(fan.pierced))) - p;
  const Vec3 x = normalized(u);
  const Vec3 y = normalized(tangentPart(v, x));
  const double turn = 0.5 * fan.angle - fan.piercedAngle;
  const Vec3 across = y * math::cos(turn) - x * math::sin(turn);
  const double du = dot(u, across);
  const double dv = dot(v, across);
  return dv - du > 0.0 ? std::clamp(-du / (dv - du), 0.0, 1.0) : 0.5;
}

/// Mean length of the two front edges.
double frontLength(const MorphMesh& morph, HalfedgeId sector) {
  return 0.5 * (morph.length(sector) + morph.length(morph.front().previousFront(sector)));
}

std::optional<SideChoice> swapChoice(const MorphMesh& morph, HalfedgeId sector, const Fan& fan, const Vec3& crossing,
                                     VertexId forbidden, const MorphOptions& options) {
  const EditMesh& mesh = morph.mesh();
  const HalfedgeId far = mesh.next(fan.pierced);
  if (morph.front().isFront(far) || !canSwap(morph.front(), far)) return std::nullopt;
  const VertexId end = mesh.origin(mesh.prev(mesh.twin(far)));
  if (end == forbidden) return std::nullopt;
  const Vec3 p = mesh.position(mesh.origin(sector));
  const Vec3 aim = crossing - p;
  const Vec3 edge = mesh.position(end) - p;
  const double deviation = math::atan2(norm(cross(aim, edge)), dot(aim, edge));
  if (deviation >= options.sideAngle || norm(edge) >= kLongestSwap * frontLength(morph, sector)) return std::nullopt;
  return SideChoice{SideChoice::Kind::swap, far, end, {}};
}

}  // namespace

std::vector<SideChoice> sideChoices(const MorphMesh& morph, HalfedgeId sector, VertexId forbidden,
                                    const MorphOptions& options) {
  const EditMesh& mesh = morph.mesh();
  const Fan fan = fanOf(morph, sector);
  std::vector<SideChoice> choices;
  if (!fan.pierced.valid()) return choices;
  const double half = 0.5 * fan.angle;
  std::vector<Spoke> spokes = fan.spokes;
  std::erase_if(spokes, [&](const Spoke& s) { return mesh.target(s.edge) == forbidden; });
  std::stable_sort(spokes.begin(), spokes.end(), [&](const Spoke& s, const Spoke& t) {
    return std::fabs(s.angle - half) < std::fabs(t.angle - half);
  });
  std::vector<SideChoice> others;
  for (const Spoke& spoke : spokes) {
    const VertexId end = mesh.target(spoke.edge);
    const double limit = options.sideAngle * (morph.front().isFree(end) ? 1.0 : kClosingFactor);
    const bool near = choices.empty() && std::fabs(spoke.angle - half) < limit;
    (near ? choices : others).push_back({SideChoice::Kind::existing, spoke.edge, end, {}});
  }
  const HalfedgeId far = mesh.next(fan.pierced);
  const double fraction = crossingOf(mesh, fan);
  const Vec3 crossing = mesh.position(mesh.origin(far)) * (1.0 - fraction) + mesh.position(mesh.target(far)) * fraction;
  if (const auto swap = swapChoice(morph, sector, fan, crossing, forbidden, options)) choices.push_back(*swap);
  const double sideLength = distance(mesh.position(mesh.origin(sector)), crossing);
  if (!morph.front().isFront(far) && fraction > kNearestSplit && fraction < 1.0 - kNearestSplit &&
      sideLength > kShortestSide * frontLength(morph, sector)) {
    choices.push_back({SideChoice::Kind::split, far, {}, morph.place(mesh.vertex(mesh.origin(far)), crossing)});
  }
  choices.insert(choices.end(), others.begin(), others.end());
  return choices;
}

VertexId realize(MorphMesh& morph, const SideChoice& choice) {
  if (choice.kind == SideChoice::Kind::swap) morph.mesh().flip(choice.edge);
  if (choice.kind == SideChoice::Kind::split) return morph.mesh().splitEdge(choice.edge, choice.vertex);
  return choice.end;
}

}  // namespace qmcf
