#include "covered_faces.hpp"

#include <algorithm>
#include <cstddef>
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

/// For how many of its edges more a face runs against the other faces than along with them; `twin` does not count.
int agreement(const Brep& brep, std::int32_t face, std::int32_t twin) {
  int sum = 0;
  for (const BrepLoop& own : brep.faces[static_cast<std::size_t>(face)].loops) {
    for (const Coedge& coedge : own.coedges) {
      for (std::size_t f = 0; f < brep.faces.size(); ++f) {
        if (static_cast<std::int32_t>(f) == face || static_cast<std::int32_t>(f) == twin) continue;
        for (const BrepLoop& loop : brep.faces[f].loops) {
          for (const Coedge& other : loop.coedges) {
            if (other.edge == coedge.edge) sum += other.reversed != coedge.reversed ? 1 : -1;
          }
        }
      }
    }
  }
  return sum;
}

/// A face's use of an edge.
struct Use {
  std::int32_t face = kNone;
  bool reversed = false;
};

/// Where two faces are left at an edge that had more, they may run along it in the same direction: faces that disagree
/// along more of their edges than they agree are turned, as long as that helps.
void turnToFit(const Brep& brep, CoveredFaces& covered) {
  constexpr int kMostRounds = 16;
  std::vector<std::vector<Use>> uses(brep.edges.size());
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    if (covered.below[f] != kNone) continue;
    for (const BrepLoop& loop : brep.faces[f].loops) {
      for (const Coedge& coedge : loop.coedges) {
        uses[static_cast<std::size_t>(coedge.edge)].push_back({static_cast<std::int32_t>(f), coedge.reversed});
      }
    }
  }
  const auto runs = [&covered](const Use& use) {
    return use.reversed != (covered.turned[static_cast<std::size_t>(use.face)] != 0);
  };
  bool changed = true;
  for (int round = 0; changed && round < kMostRounds; ++round) {
    changed = false;
    std::vector<double> agreeing(brep.faces.size(), 0.0);  // Length that agrees, less the length that does not.
    for (std::size_t e = 0; e < uses.size(); ++e) {
      if (uses[e].size() != 2 || uses[e][0].face == uses[e][1].face) continue;
      const bool agree = runs(uses[e][0]) != runs(uses[e][1]);
      for (const Use& use : uses[e]) {
        agreeing[static_cast<std::size_t>(use.face)] += agree ? brep.edges[e].length : -brep.edges[e].length;
      }
    }
    for (std::size_t f = 0; f < brep.faces.size() && !changed; ++f) {
      if (agreeing[f] >= 0.0) continue;
      covered.turned[f] ^= 1U;
      changed = true;
    }
  }
}

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

CoveredFaces coveredFaces(const Part& part, double distance) {
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
  std::vector<std::int32_t>& below = covered.below;
  for (std::size_t i = 0; i < byEdges.size(); ++i) {
    for (std::size_t j = i + 1; j < byEdges.size() && byEdges[j].first == byEdges[i].first; ++j) {
      std::int32_t kept = byEdges[i].second;
      std::int32_t omitted = byEdges[j].second;
      if (below[static_cast<std::size_t>(kept)] != kNone || below[static_cast<std::size_t>(omitted)] != kNone) continue;
      const auto first = static_cast<std::size_t>(kept);
      const auto second = static_cast<std::size_t>(omitted);
      if (!isNear(part.mesh, brep.faces[first], part.faceTrees[second], distance)) continue;
      if (!isNear(part.mesh, brep.faces[second], part.faceTrees[first], distance)) continue;
      if (agreement(brep, omitted, kept) > agreement(brep, kept, omitted)) std::swap(kept, omitted);
      below[static_cast<std::size_t>(omitted)] = kept;
    }
  }
  if (std::any_of(below.begin(), below.end(), [](std::int32_t lower) { return lower != kNone; }))
    turnToFit(brep, covered);
  preferUnturned(brep, covered);
  return covered;
}

}  // namespace qmcf
