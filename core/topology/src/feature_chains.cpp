#include <algorithm>
#include <cmath>
#include <optional>

#include "bodies.hpp"
#include "feature_edges.hpp"

namespace qmcf::detail {
namespace {

/// cos 40 degrees: a weak edge continues a chain only where it goes on about straight.
constexpr double kStraight = 0.766;
/// Weak edges in a row that a chain may be continued by.
constexpr std::size_t kLongestExtension = 64;

/// Dihedral angles down to this part of the angle that makes an edge sharp may continue a chain.
constexpr double kWeakAngle = 0.6;
/// A dangling chain shorter than this part of its body's diagonal is noise; in a scattered body, the larger part.
constexpr double kShortChain = 0.003;
constexpr double kShortScatteredChain = 0.1;
/// A body is scattered when its sharp edges have at least this many loose ends, and one per this many edges.
constexpr std::int64_t kManyLooseEnds = 8;
constexpr std::int64_t kEdgesPerLooseEnd = 12;

/// In a scattered body, a patch smaller than the square of this part of the diagonal is noise.
constexpr double kSmallPatch = 0.05;

/// What counts as a chain in one body.
struct BodyLimits {
  double strongAngle = 0.0;
  double weakAngle = 0.0;
  double shortLength = 0.0;
  double smallArea = 0.0;
};

BodyLimits limitsOf(double diagonal, double featureAngle, bool scattered) {
  BodyLimits limits;
  limits.strongAngle = scattered ? 2.0 * featureAngle : featureAngle;
  limits.weakAngle = kWeakAngle * limits.strongAngle;
  limits.shortLength = (scattered ? kShortScatteredChain : kShortChain) * diagonal;
  limits.smallArea = scattered ? kSmallPatch * kSmallPatch * diagonal * diagonal : 0.0;
  return limits;
}

std::vector<std::uint8_t> findScattered(const Bodies& bodies, const TriangleEdges& edges,
                                        const FeatureEdges& features) {
  std::vector<std::int64_t> sharp(bodies.count(), 0);
  std::vector<std::int64_t> loose(bodies.count(), 0);
  std::vector<std::int32_t> valence(edges.vertexCount(), 0);
  for (const EdgeId e : edges.edges()) {
    if (features.mark[e] == 0) continue;
    for (const VertexId v : edges.ends(e)) ++valence[v.index()];
  }
  for (const EdgeId e : edges.edges()) {
    if (!features.is(e, EdgeKind::sharp)) continue;
    const std::size_t body = bodies.of(edges, e);
    ++sharp[body];
    for (const VertexId v : edges.ends(e)) loose[body] += valence[v.index()] == 1 ? 1 : 0;
  }
  std::vector<std::uint8_t> scattered(bodies.count(), 0);
  for (std::size_t b = 0; b < bodies.count(); ++b) {
    scattered[b] = loose[b] >= kManyLooseEnds && kEdgesPerLooseEnd * loose[b] >= sharp[b] ? 1 : 0;
  }
  return scattered;
}

/// Removes the sharp marks around patches that are smaller than their body allows.
void joinSmallPatches(const TriangleMesh& mesh, const TriangleEdges& edges, const Bodies& bodies,
                      const std::vector<BodyLimits>& limits, FeatureEdges& features) {
  std::vector<std::int32_t> patchOf(mesh.triangles.size(), kNone);
  std::vector<double> area;
  for (const TriangleId root : edges.triangles()) {
    if (patchOf[root.index()] != kNone) continue;
    double sum = 0.0;
    flood(edges, root, &features.mark, patchOf, static_cast<std::int32_t>(area.size()), [&](TriangleId t) {
      const auto& c = mesh.triangles[t.index()];
      const Vec3& p = mesh.positions[static_cast<std::size_t>(c[0])];
      sum += 0.5 * norm(cross(mesh.positions[static_cast<std::size_t>(c[1])] - p,
                              mesh.positions[static_cast<std::size_t>(c[2])] - p));
    });
    area.push_back(sum);
  }
  for (const EdgeId e : edges.edges()) {
    if (!features.is(e, EdgeKind::sharp)) continue;
    const double smallArea = limits[bodies.of(edges, e)].smallArea;
    for (const HalfedgeId h : edges.uses(e)) {
      const auto patch = static_cast<std::size_t>(patchOf[Surface::triangle(h).index()]);
      if (area[patch] < smallArea) features.mark[e] = 0;
    }
  }
}

class Chains {
 public:
  Chains(const TriangleMesh& mesh, const TriangleEdges& edges, FeatureEdges& features, const Bodies& bodies,
         const std::vector<BodyLimits>& limits)
      : mesh_(mesh),
        edges_(edges),
        features_(features),
        bodies_(bodies),
        limits_(limits),
        around_(edges, candidates()) {
    valence_.assign(mesh.positions.size(), 0);
    for (const EdgeId e : edges.edges()) {
      if (features.mark[e] != 0) changeValence(e, 1);
    }
  }

  void extend() {
    for (std::size_t v = 0; v < valence_.size(); ++v) {
      const VertexId end(v);
      const EdgeId last = looseEdge(end);
      if (!last.valid()) continue;
      for (const EdgeId e : pathToFeature(end, last)) {
        features_.set(e, EdgeKind::sharp);
        changeValence(e, 1);
      }
    }
  }

  void prune() {
    for (bool changed = true; changed;) {
      std::vector<EdgeId> dropped;
      for (std::size_t v = 0; v < valence_.size(); ++v) {
        const EdgeId first = looseEdge(VertexId(v));
        if (first.valid()) collectIfShort(VertexId(v), first, dropped);
      }
      std::sort(dropped.begin(), dropped.end());
      dropped.erase(std::unique(dropped.begin(), dropped.end()), dropped.end());
      for (const EdgeId e : dropped) {
        features_.mark[e] = 0;
        changeValence(e, -1);
      }
      changed = !dropped.empty();
    }
  }

 private:
  [[nodiscard]] const BodyLimits& limitsOf(EdgeId e) const { return limits_[bodies_.of(edges_, e)]; }

  [[nodiscard]] IdMap<EdgeId, std::uint8_t> candidates() const {
    IdMap<EdgeId, std::uint8_t> keep = features_.mark;
    for (const EdgeId e : edges_.edges()) {
      if (features_.dihedral[e] >= limitsOf(e).weakAngle) keep[e] = 1;
    }
    return keep;
  }

  void changeValence(EdgeId e, int by) {
    for (const VertexId v : edges_.ends(e)) valence_[v.index()] += by;
  }

  [[nodiscard]] Vec3 along(EdgeId e, VertexId from) const {
    return mesh_.positions[edges_.otherEnd(e, from).index()] - mesh_.positions[from.index()];
  }

  /// The one cutting edge at v, if it is a sharp or label edge.
  [[nodiscard]] EdgeId looseEdge(VertexId v) const {
    if (valence_[v.index()] != 1) return EdgeId();
    for (const EdgeId e : around_.at(v)) {
      if (features_.mark[e] == 0) continue;
      return features_.is(e, EdgeKind::sharp) || features_.is(e, EdgeKind::label) ? e : EdgeId();
    }
    return EdgeId();
  }

  /// The straightest weak edge at v that goes on from edge `last`.
  [[nodiscard]] EdgeId straightest(VertexId v, EdgeId last) const {
    const Vec3 direction = normalized(-along(last, v));
    EdgeId best;
    double bestCosine = kStraight;
    for (const EdgeId e : around_.at(v)) {
      if (features_.mark[e] != 0) continue;
      const double cosine = dot(direction, normalized(along(e, v)));
      if (cosine <= bestCosine) continue;
      best = e;
      bestCosine = cosine;
    }
    return best;
  }

  /// Weak edges from the loose end to a vertex with another cutting edge; empty when there is no such path.
  [[nodiscard]] std::vector<EdgeId> pathToFeature(VertexId end, EdgeId last) const {
    std::vector<EdgeId> path;
    std::vector<VertexId> visited{end};
    VertexId v = end;
    while (path.size() < kLongestExtension) {
      last = straightest(v, last);
      if (!last.valid()) return {};
      path.push_back(last);
      v = edges_.otherEnd(last, v);
      if (valence_[v.index()] > 0) return path;
      if (std::find(visited.begin(), visited.end(), v) != visited.end()) return {};
      visited.push_back(v);
    }
    return {};
  }

  /// Follows the chain from its loose end; adds its edges to `dropped` when it is short, or a single edge with two
  /// loose ends: that could not be cut open.
  void collectIfShort(VertexId v, EdgeId first, std::vector<EdgeId>& dropped) const {
    std::vector<EdgeId> chain;
    const double shortLength = limitsOf(first).shortLength;
    double length = 0.0;
    EdgeId e = first;
    while (e.valid() && length < shortLength) {
      chain.push_back(e);
      length += norm(along(e, v));
      v = edges_.otherEnd(e, v);
      if (valence_[v.index()] != 2) break;
      EdgeId next;
      for (const EdgeId g : around_.at(v)) {
        if (features_.mark[g] != 0 && g != e) next = g;
      }
      // A boundary or non-manifold edge is never dropped; the chain ends there.
      if (features_.is(next, EdgeKind::boundary) || features_.is(next, EdgeKind::nonManifold)) break;
      e = next;
    }
    const bool single = chain.size() == 1 && valence_[v.index()] == 1;
    if (length < shortLength || single) dropped.insert(dropped.end(), chain.begin(), chain.end());
  }

  const TriangleMesh& mesh_;
  const TriangleEdges& edges_;
  FeatureEdges& features_;
  const Bodies& bodies_;
  const std::vector<BodyLimits>& limits_;
  VertexEdges around_;
  std::vector<int> valence_;
};

/// Marks the vertices where creases end or branch. In a scattered body that is noise.
void markJunctions(const TriangleEdges& edges, const Bodies& bodies, const std::vector<std::uint8_t>& scattered,
                   FlatEdges flat, FeatureEdges& features) {
  for (auto& ends : flat) std::sort(ends.begin(), ends.end());
  std::sort(flat.begin(), flat.end());
  std::vector<std::int32_t> valence(edges.vertexCount(), 0);
  for (const EdgeId e : edges.edges()) {
    if (features.mark[e] == 0 || scattered[bodies.of(edges, e)] != 0) continue;
    const auto ends = edges.ends(e);
    if (std::binary_search(flat.begin(), flat.end(), std::array{ends[0].value, ends[1].value})) continue;
    for (const VertexId v : ends) ++valence[v.index()];
  }
  features.junction.assign(valence.size(), 0);
  for (std::size_t v = 0; v < valence.size(); ++v) features.junction[v] = valence[v] != 0 && valence[v] != 2 ? 1 : 0;
}

/// A single edge in the middle of a sheet can't be cut open. Pruning leaves one where another sheet touches its end.
void dropLoneEdges(const TriangleEdges& edges, FeatureEdges& features) {
  const Fans fans = buildFans(edges, features.mark);
  for (const EdgeId e : edges.edges()) {
    if (!features.is(e, EdgeKind::sharp) && !features.is(e, EdgeKind::label)) continue;
    const HalfedgeId h = edges.uses(e)[0];
    const HalfedgeId g = edges.uses(e)[1];
    if (nextCut(fans, h) == g && nextCut(fans, g) == h) features.mark[e] = 0;
  }
}

}  // namespace

std::vector<std::uint8_t> cleanFeatureChains(const TriangleMesh& mesh, const TriangleEdges& edges, const Bodies& bodies,
                                             double featureAngle, const FlatEdges& flat, FeatureEdges& features) {
  std::vector<std::uint8_t> scattered = findScattered(bodies, edges, features);
  std::vector<BodyLimits> limits;
  for (std::size_t b = 0; b < bodies.count(); ++b) {
    limits.push_back(limitsOf(bodies.diagonal[b], featureAngle, scattered[b] != 0));
  }
  for (const EdgeId e : edges.edges()) {
    if (features.is(e, EdgeKind::sharp) && features.dihedral[e] < limits[bodies.of(edges, e)].strongAngle) {
      features.mark[e] = 0;
    }
  }
  markJunctions(edges, bodies, scattered, flat, features);
  {
    Chains chains(mesh, edges, features, bodies, limits);
    chains.extend();
    chains.prune();
  }
  if (std::find(scattered.begin(), scattered.end(), 1) != scattered.end()) {
    joinSmallPatches(mesh, edges, bodies, limits, features);
    Chains(mesh, edges, features, bodies, limits).prune();
  }
  dropLoneEdges(edges, features);
  return scattered;
}

}  // namespace qmcf::detail
