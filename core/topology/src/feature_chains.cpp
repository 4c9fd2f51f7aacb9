#include <algorithm>
#include <cmath>
#include <optional>

#include "feature_edges.hpp"

namespace qmcf::detail {
namespace {

/// cos 40 degrees: a weak edge continues a chain only where it goes on about straight.
constexpr double kStraight = 0.766;
/// Weak edges in a row that a chain may be continued by.
constexpr std::size_t kLongestExtension = 64;

class Chains {
 public:
  Chains(const TriangleMesh& mesh, const TriangleEdges& edges, FeatureEdges& features, const ChainLimits& limits)
      : mesh_(mesh), edges_(edges), features_(features), limits_(limits), around_(edges, candidates()) {
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
  [[nodiscard]] IdMap<EdgeId, std::uint8_t> candidates() const {
    IdMap<EdgeId, std::uint8_t> keep = features_.mark;
    for (const EdgeId e : edges_.edges()) {
      if (features_.dihedral[e] >= limits_.weakAngle) keep[e] = 1;
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
    double length = 0.0;
    EdgeId e = first;
    while (e.valid() && length < limits_.shortLength) {
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
    if (length < limits_.shortLength || single) dropped.insert(dropped.end(), chain.begin(), chain.end());
  }

  const TriangleMesh& mesh_;
  const TriangleEdges& edges_;
  FeatureEdges& features_;
  const ChainLimits& limits_;
  VertexEdges around_;
  std::vector<int> valence_;
};

}  // namespace

void cleanFeatureChains(const TriangleMesh& mesh, const TriangleEdges& edges, const ChainLimits& limits,
                        FeatureEdges& features) {
  Chains chains(mesh, edges, features, limits);
  chains.extend();
  chains.prune();
}

}  // namespace qmcf::detail
