// Orientation of the triangles, patch by patch: a patch is a set of triangles connected across two-sided edges.

#include <algorithm>
#include <array>
#include <cmath>

#include "qmcf/base/bounding_box.hpp"
#include "qmcf/base/math.hpp"
#include "repair_state.hpp"
#include "triangle_edges.hpp"

namespace qmcf::detail {
namespace {

struct Patch {
  std::vector<std::int32_t> triangles;
  std::int64_t turned = 0;  ///< Triangles whose flag `turn` is set.
  bool closed = true;       ///< Its directed edges cancel: it bounds a volume.
  double volume = 0.0;      ///< Six times the signed volume, when closed.
  BoundingBox box;
};

struct Orientation {
  std::vector<std::int32_t> patchOf;
  std::vector<std::uint8_t> turn;  ///< Triangle is to be turned round.
  std::vector<Patch> patches;
  std::vector<EdgeId> conflicts;  ///< Two-sided edges whose triangles can't agree (Moebius).
};

/// The half-edges of t in an order that does not depend on its orientation, so that repairing again changes nothing.
std::array<HalfedgeId, 3> halfedgesByEdge(const TriangleEdges& edges, TriangleId t) {
  std::array<HalfedgeId, 3> sides{Surface::halfedge(t, 0), Surface::halfedge(t, 1), Surface::halfedge(t, 2)};
  std::sort(sides.begin(), sides.end(), [&](HalfedgeId g, HalfedgeId h) { return edges.edge(g) < edges.edge(h); });
  return sides;
}

/// Floods patches; within each, all agree with its first triangle as far as possible.
Orientation flood(const TriangleEdges& edges) {
  Orientation result;
  const std::size_t count = edges.halfedgeCount() / 3;
  result.patchOf.assign(count, kNone);
  result.turn.assign(count, 0);
  for (const TriangleId root : edges.triangles()) {
    if (result.patchOf[root.index()] != kNone) continue;
    const auto id = static_cast<std::int32_t>(result.patches.size());
    Patch patch;
    patch.triangles.push_back(root.value);
    result.patchOf[root.index()] = id;
    for (std::size_t i = 0; i < patch.triangles.size(); ++i) {
      const TriangleId t(patch.triangles[i]);
      for (const HalfedgeId h : halfedgesByEdge(edges, t)) {
        const HalfedgeId g = edges.other(h);
        if (!g.valid()) continue;
        const TriangleId u = Surface::triangle(g);
        const bool opposed = edges.origin(g) != edges.origin(h);
        const auto wanted = static_cast<std::uint8_t>(opposed ? result.turn[t.index()] : 1 - result.turn[t.index()]);
        if (result.patchOf[u.index()] == kNone) {
          result.patchOf[u.index()] = id;
          result.turn[u.index()] = wanted;
          patch.triangles.push_back(u.value);
        } else if (result.turn[u.index()] != wanted && h < g) {
          result.conflicts.push_back(edges.edge(h));
          patch.closed = false;
        }
      }
    }
    std::sort(patch.triangles.begin(), patch.triangles.end());
    for (const std::int32_t t : patch.triangles) patch.turned += result.turn[static_cast<std::size_t>(t)];
    result.patches.push_back(std::move(patch));
  }
  return result;
}

void turnPatch(Orientation& orientation, Patch& patch) {
  for (const std::int32_t t : patch.triangles) orientation.turn[static_cast<std::size_t>(t)] ^= 1U;
  patch.turned = static_cast<std::int64_t>(patch.triangles.size()) - patch.turned;
  patch.volume = -patch.volume;
}

/// A patch is open when at some edge its triangles, as turned, do not run equally often in both directions.
void findOpenPatches(const TriangleEdges& edges, Orientation& orientation) {
  for (const EdgeId e : edges.edges()) {
    const auto uses = edges.uses(e);
    if (uses.size() == 2) continue;
    std::vector<std::pair<std::int32_t, int>> sum;  // patch, direction
    for (const HalfedgeId h : uses) {
      const std::size_t t = Surface::triangle(h).index();
      const bool forward = (edges.origin(h) == edges.ends(e)[0]) != (orientation.turn[t] != 0);
      sum.emplace_back(orientation.patchOf[t], forward ? 1 : -1);
    }
    std::sort(sum.begin(), sum.end());
    for (std::size_t i = 0; i < sum.size();) {
      int total = 0;
      const std::int32_t patch = sum[i].first;
      for (; i < sum.size() && sum[i].first == patch; ++i) total += sum[i].second;
      if (total != 0) orientation.patches[static_cast<std::size_t>(patch)].closed = false;
    }
  }
}

std::array<Vec3, 3> cornersOf(const TriangleMesh& mesh, std::int32_t t, bool turned) {
  const auto& c = mesh.triangles[static_cast<std::size_t>(t)];
  const auto p = [&](std::size_t i) { return mesh.positions[static_cast<std::size_t>(c[i])]; };
  return turned ? std::array{p(0), p(2), p(1)} : std::array{p(0), p(1), p(2)};
}

void measure(const TriangleMesh& mesh, const Orientation& orientation, Patch& patch) {
  const Vec3 origin = cornersOf(mesh, patch.triangles.front(), false)[0];
  for (const std::int32_t t : patch.triangles) {
    const auto p = cornersOf(mesh, t, orientation.turn[static_cast<std::size_t>(t)] != 0);
    patch.volume += dot(p[0] - origin, cross(p[1] - origin, p[2] - origin));
    for (const Vec3& q : p) patch.box.include(q);
  }
}

/// How often the patch winds around the point: sum of the solid angles (van Oosterom and Strackee 1983) over 4 pi.
double windingNumber(const TriangleMesh& mesh, const Orientation& orientation, const Patch& patch, const Vec3& point) {
  double sum = 0.0;
  for (const std::int32_t t : patch.triangles) {
    const auto p = cornersOf(mesh, t, orientation.turn[static_cast<std::size_t>(t)] != 0);
    const Vec3 a = p[0] - point;
    const Vec3 b = p[1] - point;
    const Vec3 c = p[2] - point;
    const double la = norm(a);
    const double lb = norm(b);
    const double lc = norm(c);
    sum += math::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (2.0 * math::kPi);
}

/// Solid angles computed before shells within shells are left as the file has them.
constexpr std::int64_t kWindingBudget = 200'000'000;

/// The file says that the patch faces inwards; that is right for the wall of a cavity, which lies inside an odd number
/// of other closed patches.
bool isCavity(const TriangleMesh& mesh, const Orientation& orientation, const Patch& patch, std::int64_t& budget) {
  const auto corners = cornersOf(mesh, patch.triangles.front(), false);
  const Vec3 point = (corners[0] + corners[1] + corners[2]) / 3.0;
  int depth = 0;
  for (const Patch& outer : orientation.patches) {
    if (&outer == &patch || !outer.closed || !outer.box.contains(patch.box)) continue;
    budget -= static_cast<std::int64_t>(outer.triangles.size());
    if (budget < 0) return true;
    if (std::fabs(windingNumber(mesh, orientation, outer, point)) > 0.5) ++depth;
  }
  return depth % 2 == 1;
}

/// Turns patches so that open ones keep what most of their triangles had and, in a file that contradicts itself, closed
/// ones face outwards. In a file that doesn't, the sides are a statement: shells that face inwards are only reported.
void choosePatchSides(const RepairState& state, Orientation& orientation, RepairItem& inward) {
  const auto isMixed = [](const Patch& patch) {
    return patch.turned != 0 && patch.turned != static_cast<std::int64_t>(patch.triangles.size());
  };
  const bool contradicts = std::any_of(orientation.patches.begin(), orientation.patches.end(), isMixed);
  for (Patch& patch : orientation.patches) {
    if (2 * patch.turned > static_cast<std::int64_t>(patch.triangles.size())) turnPatch(orientation, patch);
    if (patch.closed) measure(state.mesh, orientation, patch);
  }
  const double noVolume = 1e-12 * state.diagonal * state.diagonal * state.diagonal;
  std::int64_t budget = kWindingBudget;
  std::vector<std::size_t> turned;
  for (std::size_t i = 0; i < orientation.patches.size(); ++i) {
    const Patch& patch = orientation.patches[i];
    if (!patch.closed || patch.volume >= -noVolume) continue;
    if (!isCavity(state.mesh, orientation, patch, budget)) turned.push_back(i);
  }
  for (const std::size_t i : turned) {
    Patch& patch = orientation.patches[i];
    note(inward, state.origin[static_cast<std::size_t>(patch.triangles.front())]);
    if (contradicts) turnPatch(orientation, patch);
  }
  if (!contradicts) inward.action = "found and left as they are: all else in the file agrees with them";
}

}  // namespace

void orient(RepairState& state) {
  const TriangleEdges edges(state.mesh.triangles, state.mesh.positions.size());
  Orientation orientation = flood(edges);
  findOpenPatches(edges, orientation);

  const bool modify = state.modify;
  RepairItem mixed{"misorientedTriangles", modify ? "turned round" : "found", 0, {}};
  RepairItem inward{"inwardShells", modify ? "turned inside out" : "found", 0, {}};
  RepairItem conflicts{"oneSidedEdges", "the surface is cut there: it has one side only", 0, {}};
  choosePatchSides(state, orientation, inward);
  for (const Patch& patch : orientation.patches) {
    if (patch.turned == static_cast<std::int64_t>(patch.triangles.size())) continue;
    for (const std::int32_t t : patch.triangles) {
      // In a shell that is turned as a whole the misoriented triangles are those that stay.
      const bool turned = orientation.turn[static_cast<std::size_t>(t)] != 0;
      const bool minority = 2 * patch.turned > static_cast<std::int64_t>(patch.triangles.size()) ? !turned : turned;
      if (minority) note(mixed, state.origin[static_cast<std::size_t>(t)]);
    }
  }
  for (const EdgeId e : orientation.conflicts) {
    note(conflicts, state.origin[Surface::triangle(edges.uses(e)[0]).index()]);
  }
  addItem(state, std::move(mixed));
  addItem(state, std::move(inward));
  addItem(state, std::move(conflicts));
  if (!modify) return;
  for (std::size_t t = 0; t < state.mesh.triangles.size(); ++t) {
    if (orientation.turn[t] != 0) std::swap(state.mesh.triangles[t][1], state.mesh.triangles[t][2]);
  }
}

}  // namespace qmcf::detail
