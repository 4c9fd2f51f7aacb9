#include "covered_faces.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

namespace qmcf {
namespace {

std::vector<std::int32_t> edgesOf(const BrepFace& face) {
  std::vector<std::int32_t> edges;
  for (const BrepLoop& loop : face.loops) {
    for (const Coedge& coedge : loop.coedges) edges.push_back(coedge.edge);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Whether the corners and centres of the upper face's triangles are near the lower face.
bool isNear(const TriangleMesh& mesh, const BrepFace& upper, const TriangleBvh& lower, double distance) {
  for (const std::int32_t t : upper.triangles) {
    Vec3 centre;
    for (const std::int32_t v : mesh.triangles[static_cast<std::size_t>(t)]) {
      const Vec3& p = mesh.positions[static_cast<std::size_t>(v)];
      if (lower.closest(p).squaredDistance > distance * distance) return false;
      centre += p / 3.0;
    }
    if (lower.closest(centre).squaredDistance > distance * distance) return false;
  }
  return true;
}

/// A face's use of an edge.
struct Use {
  std::int32_t face = kNone;
  bool reversed = false;
};

/// Per edge.
using Uses = std::vector<std::vector<Use>>;

Uses usesOf(const Brep& brep) {
  Uses uses(brep.edges.size());
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    for (const BrepLoop& loop : brep.faces[f].loops) {
      for (const Coedge& coedge : loop.coedges) {
        uses[static_cast<std::size_t>(coedge.edge)].push_back({static_cast<std::int32_t>(f), coedge.reversed});
      }
    }
  }
  return uses;
}

/// For how many of its edges more a face runs against the other faces than along with them; `twin` does not count.
int agreement(const Brep& brep, const Uses& uses, std::int32_t face, std::int32_t twin) {
  int sum = 0;
  for (const BrepLoop& loop : brep.faces[static_cast<std::size_t>(face)].loops) {
    for (const Coedge& coedge : loop.coedges) {
      for (const Use& other : uses[static_cast<std::size_t>(coedge.edge)]) {
        if (other.face != face && other.face != twin) sum += other.reversed != coedge.reversed ? 1 : -1;
      }
    }
  }
  return sum;
}

/// Where two faces are left at an edge that had more, they may run along it in the same direction: faces that disagree
/// along more of their edges than they agree are turned, as long as that helps.
class Turning {
 public:
  Turning(const Brep& brep, const Uses& uses, CoveredFaces& covered) : brep_(brep), covered_(covered) {
    pair_.resize(uses.size());
    for (std::size_t e = 0; e < uses.size(); ++e) {
      std::copy_if(uses[e].begin(), uses[e].end(), std::back_inserter(pair_[e]),
                   [&covered](const Use& use) { return covered.below[static_cast<std::size_t>(use.face)] == kNone; });
      if (pair_[e].size() != 2 || pair_[e][0].face == pair_[e][1].face) pair_[e].clear();
    }
  }

  void run() {
    std::vector<std::size_t> queue(brep_.faces.size());
    std::iota(queue.begin(), queue.end(), std::size_t{0});
    std::vector<std::uint8_t> queued(queue.size(), 1);
    // Each turn makes the length that agrees larger, so that this ends; round-off shall not keep it from that.
    std::size_t left = brep_.faces.size();
    for (std::size_t i = 0; i < queue.size() && left > 0; ++i) {
      const std::size_t face = queue[i];
      queued[face] = 0;
      const std::vector<std::int32_t> edges = edgesOf(brep_.faces[face]);
      if (agreeing(edges) >= 0.0) continue;
      covered_.turned[face] ^= 1U;
      --left;
      for (const std::int32_t e : edges) {
        for (const Use& use : pair_[static_cast<std::size_t>(e)]) {
          const auto other = static_cast<std::size_t>(use.face);
          if (other == face || queued[other] != 0) continue;
          queued[other] = 1;
          queue.push_back(other);
        }
      }
    }
  }

 private:
  [[nodiscard]] bool runsBackwards(const Use& use) const {
    return use.reversed != (covered_.turned[static_cast<std::size_t>(use.face)] != 0);
  }

  /// The length of a face's edges that agree, less the length of those that do not.
  [[nodiscard]] double agreeing(const std::vector<std::int32_t>& edges) const {
    double sum = 0.0;
    for (const std::int32_t edge : edges) {
      const auto e = static_cast<std::size_t>(edge);
      if (pair_[e].empty()) continue;
      sum += runsBackwards(pair_[e][0]) != runsBackwards(pair_[e][1]) ? brep_.edges[e].length : -brep_.edges[e].length;
    }
    return sum;
  }

  const Brep& brep_;
  CoveredFaces& covered_;
  Uses pair_;  ///< Per edge: the two faces that are left beside it; elsewhere none.
};

/// How a face runs along an edge that it uses.
bool runsBackwards(const BrepFace& face, std::int32_t edge) {
  for (const BrepLoop& loop : face.loops) {
    for (const Coedge& coedge : loop.coedges) {
      if (coedge.edge == edge) return coedge.reversed;
    }
  }
  return false;
}

/// Instead of a face that would have to be turned, the layer that faces the other way is meshed as it is.
void preferUnturned(const Brep& brep, CoveredFaces& covered) {
  for (std::size_t f = 0; f < covered.below.size(); ++f) {
    const std::int32_t kept = covered.below[f];
    if (kept == kNone || covered.turned[static_cast<std::size_t>(kept)] == 0) continue;
    const std::int32_t edge = brep.faces[f].loops[0].coedges[0].edge;
    if (runsBackwards(brep.faces[f], edge) == runsBackwards(brep.faces[static_cast<std::size_t>(kept)], edge)) continue;
    covered.below[f] = kNone;
    covered.below[static_cast<std::size_t>(kept)] = static_cast<std::int32_t>(f);
    covered.turned[static_cast<std::size_t>(kept)] = 0;
  }
}

}  // namespace

Result<CoveredFaces> coveredFaces(const Part& part, double distance, Progress& progress) {
  const Brep& brep = part.brep;
  std::vector<std::pair<std::vector<std::int32_t>, std::int32_t>> byEdges;
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    // Elsewhere the edges would be left with one face, and open.
    std::vector<std::int32_t> edges = edgesOf(brep.faces[f]);
    const bool hasOthers = std::all_of(edges.begin(), edges.end(), [&brep](std::int32_t e) {
      return brep.edges[static_cast<std::size_t>(e)].kind == EdgeKind::nonManifold;
    });
    if (edges.empty() || !hasOthers) continue;
    byEdges.emplace_back(std::move(edges), static_cast<std::int32_t>(f));
  }
  std::sort(byEdges.begin(), byEdges.end());
  CoveredFaces covered{std::vector<std::int32_t>(brep.faces.size(), kNone),
                       std::vector<std::uint8_t>(brep.faces.size(), 0)};
  if (byEdges.empty()) return covered;
  const Uses uses = usesOf(brep);
  std::vector<std::int32_t>& below = covered.below;
  for (std::size_t i = 0; i < byEdges.size(); ++i) {
    if (!progress.report(Stage::front, 0.0)) return cancelledError();
    for (std::size_t j = i + 1; j < byEdges.size() && byEdges[j].first == byEdges[i].first; ++j) {
      std::int32_t kept = byEdges[i].second;
      std::int32_t omitted = byEdges[j].second;
      if (below[static_cast<std::size_t>(kept)] != kNone || below[static_cast<std::size_t>(omitted)] != kNone) continue;
      const auto first = static_cast<std::size_t>(kept);
      const auto second = static_cast<std::size_t>(omitted);
      if (!isNear(part.mesh, brep.faces[first], part.faceTrees[second], distance)) continue;
      if (!isNear(part.mesh, brep.faces[second], part.faceTrees[first], distance)) continue;
      if (agreement(brep, uses, omitted, kept) > agreement(brep, uses, kept, omitted)) std::swap(kept, omitted);
      below[static_cast<std::size_t>(omitted)] = kept;
    }
  }
  if (std::any_of(below.begin(), below.end(), [](std::int32_t lower) { return lower != kNone; }))
    Turning(brep, uses, covered).run();
  preferUnturned(brep, covered);
  return covered;
}

}  // namespace qmcf
