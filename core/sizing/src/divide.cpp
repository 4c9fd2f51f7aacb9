#include "qmcf/sizing/divide.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "align_sides.hpp"
#include "edge_plan.hpp"
#include "face_uses.hpp"
#include "narrow_faces.hpp"
#include "node_places.hpp"
#include "parity.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/sizing/edge_curve.hpp"
#include "side_balance.hpp"

namespace qmcf {
namespace {

EdgeSizes sizesOf(const SizeField& size, const BrepEdge& edge, const EdgeCurve& curve, std::size_t e) {
  if (e < size.edges.size()) return size.edges[e];
  EdgeSizes sizes{curve.arcLength, {}};
  for (const std::int32_t point : edge.points) sizes.value.push_back(size.value[static_cast<std::size_t>(point)]);
  return sizes;
}

/// The least number of divisions from `count` on whose chords follow the edge; `count` where half as many again don't.
std::int32_t followingCount(const PlacedCurve& placed, std::int32_t count, double mostSagitta) {
  const std::int32_t most = count + count / 2 + 2;
  for (std::int32_t n = count; n <= most; ++n) {
    if (placeNodesOnCurve(placed, n).sagitta <= mostSagitta) return n;
  }
  return count;
}

/// How closely chords follow the edge where a face asked for divisions, in lengths of these.
constexpr double kClose = 0.5;

EdgePlan planEdge(const TriangleMesh& mesh, const BrepEdge& edge, const SizeField& size, std::size_t e,
                  std::int32_t minimum) {
  EdgePlan plan;
  plan.curve = edgeCurve(mesh, edge);
  plan.sizes = sizesOf(size, edge, plan.curve, e);
  plan.integral = plan.sizes.divisions();
  plan.stops = edge.stops;
  plan.chordSize = size.chordSize;
  // Divisions that a face asked for are there for its chords: corners of a coarse polygon become nodes, whatever the
  // size.
  if (minimum > 1) plan.chordSize = std::min(plan.chordSize, kClose * plan.curve.length() / minimum);
  plan.least = std::max(minimum, plan.curve.closed ? 3 : 1);
  if (e < size.minimumDivisions.size()) plan.least = std::max(plan.least, size.minimumDivisions[e]);
  plan.count = std::max(plan.least, static_cast<std::int32_t>(std::floor(plan.wanted() + 0.5)));
  plan.count = followingCount(plan, plan.count, size.mostSagitta);
  // One fewer, if that is as good.
  if (plan.count > plan.least && placeNodesOnCurve(plan, plan.count - 1).sagitta > size.mostSagitta) {
    plan.least = plan.count;
  }
  return plan;
}

/// The curve's own points become the nodes.
void keepPoints(EdgePlan& plan) {
  plan.asGiven = true;
  plan.count = plan.least = static_cast<std::int32_t>(plan.curve.points.size()) - 1;
}

/// Of edges between the same two vertices only one may stay undivided: they would be one edge of the mesh.
void separateParallelEdges(std::vector<EdgePlan>& plans, const Brep& brep) {
  std::vector<std::array<std::int32_t, 3>> byEnds;  // Both ends, ascending, and the edge.
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const auto [first, last] = std::minmax(brep.edges[e].start, brep.edges[e].end);
    if (first != last) byEnds.push_back({first, last, static_cast<std::int32_t>(e)});
  }
  std::sort(byEnds.begin(), byEnds.end());
  for (std::size_t i = 0; i < byEnds.size();) {
    std::size_t end = i + 1;
    while (end < byEnds.size() && byEnds[end][0] == byEnds[i][0] && byEnds[end][1] == byEnds[i][1]) ++end;
    const auto planOf = [&](std::size_t k) -> EdgePlan& { return plans[static_cast<std::size_t>(byEnds[k][2])]; };
    std::size_t shortest = i;
    for (std::size_t k = i + 1; k < end; ++k) {
      if (planOf(k).wanted() < planOf(shortest).wanted()) shortest = k;
    }
    for (std::size_t k = i; k < end; ++k) {
      if (planOf(k).asGiven && planOf(k).count == 1) shortest = k;
    }
    for (; i < end; ++i) {
      if (i == shortest || planOf(i).asGiven) continue;
      planOf(i).least = std::max(planOf(i).least, 2);
      planOf(i).count = std::max(planOf(i).count, 2);
    }
  }
}

double misfit(double count, double wanted) {
  constexpr double kTiny = 1e-3;
  const double w = std::max(wanted, kTiny);
  return std::max(count / w, w / count) - 1.0;
}

/// A change of one division on an edge, in the better direction.
struct Step {
  std::int32_t by = 1;
  double cost = 0.0;
};

Step stepOf(const EdgePlan& plan) {
  const double up = misfit(plan.count + 1.0, plan.wanted());
  const double down = misfit(std::max(plan.count - 1.0, 0.5), plan.wanted());
  return plan.count > plan.least && down < up ? Step{-1, down} : Step{1, up};
}

std::vector<double> wantedOf(const std::vector<EdgePlan>& plans) {
  std::vector<double> wanted;
  for (const EdgePlan& plan : plans) wanted.push_back(plan.wanted());
  return wanted;
}

/// Three quadrilaterals around the middle of a triangle smaller than an element need two divisions on each side.
void halveTinyTriangles(std::vector<EdgePlan>& plans, const Brep& brep) {
  const std::vector<double> wanted = wantedOf(plans);
  for (const BrepFace& face : brep.faces) {
    if (!isTinyTriangle(face, wanted)) continue;
    for (const Coedge& coedge : face.loops[0].coedges) {
      EdgePlan& plan = plans[static_cast<std::size_t>(coedge.edge)];
      if (plan.asGiven) continue;
      plan.least = std::max(plan.least, 2);
      plan.count = std::max(plan.count, 2);
    }
  }
}

/// Makes the number of divisions around each face even wherever that is possible, and odd where that suits the face
/// better, unless there shall be quadrilaterals only.
void makeEven(std::vector<EdgePlan>& plans, const Brep& brep, bool quadsOnly) {
  const auto uses = oddUses(brep);
  const std::vector<double> wanted = wantedOf(plans);
  std::vector<bool> odd;
  for (const BrepFace& face : brep.faces) odd.push_back(!quadsOnly && suitsOdd(brep, face, wanted));
  std::vector<std::size_t> changing;
  std::vector<ParityChange> changes;
  for (std::size_t e = 0; e < plans.size(); ++e) {
    if (plans[e].count % 2 != 0) {
      for (const std::int32_t f : uses[e]) odd[static_cast<std::size_t>(f)] = !odd[static_cast<std::size_t>(f)];
    }
    if (plans[e].asGiven) continue;
    changing.push_back(e);
    changes.push_back({uses[e], stepOf(plans[e]).cost});
  }
  const std::vector<bool> apply = solveParity(std::move(odd), changes).apply;
  for (std::size_t c = 0; c < changing.size(); ++c) {
    EdgePlan& plan = plans[changing[c]];
    if (apply[c]) plan.count += stepOf(plan).by;
  }
}

/// Faces with an odd number of divisions around them.
std::int64_t oddFacesOf(const std::vector<EdgePlan>& plans, const Brep& brep) {
  return std::count_if(brep.faces.begin(), brep.faces.end(), [&](const BrepFace& face) {
    std::int32_t sum = 0;
    for (const BrepLoop& loop : face.loops) {
      for (const Coedge& coedge : loop.coedges) sum += plans[static_cast<std::size_t>(coedge.edge)].count;
    }
    return sum % 2 != 0;
  });
}

/// A face inside a loop of two edges has no room for a triangle: loops get three at least, by steps that keep parity.
void fillSmallLoops(std::vector<EdgePlan>& plans, const Brep& brep) {
  for (const BrepFace& face : brep.faces) {
    for (const BrepLoop& loop : face.loops) {
      std::int32_t sum = 0;
      std::size_t longest = 0;
      for (std::size_t c = 0; c < loop.coedges.size(); ++c) {
        const auto plan = [&](std::size_t i) -> const EdgePlan& {
          return plans[static_cast<std::size_t>(loop.coedges[i].edge)];
        };
        sum += plan(c).count;
        if (plan(c).wanted() > plan(longest).wanted()) longest = c;
      }
      // The points of a given edge are enough: two neighbouring points have one edge of the part between them.
      if (sum < 3 && !loop.coedges.empty() && !plans[static_cast<std::size_t>(loop.coedges[longest].edge)].asGiven)
        plans[static_cast<std::size_t>(loop.coedges[longest].edge)].count += 2;
    }
  }
}

void balance(std::vector<EdgePlan>& plans, const TriangleMesh& mesh, const Brep& brep) {
  std::vector<EdgeCount> counts;
  for (const EdgePlan& plan : plans) counts.push_back({plan.wanted(), plan.least, plan.count, plan.asGiven});
  balanceSides(mesh, brep, counts);
  for (std::size_t e = 0; e < plans.size(); ++e) plans[e].count = counts[e].count;
}

void placeNodes(DividedEdges& divided, const EdgePlan& plan, const BrepEdge& edge, std::vector<double> places) {
  EdgeDivision division;
  division.arcLength = std::move(places);
  for (std::size_t i = 0; i < division.arcLength.size(); ++i) {
    const double s = division.arcLength[i];
    const double h = interpolate(plan.sizes.arcLength, plan.sizes.value, s);
    const bool isStart = i == 0;
    const bool isEnd = i + 1 == division.arcLength.size();
    if (isStart || isEnd) {
      const std::int32_t node = isStart ? edge.start : edge.end;
      double& nodeSize = divided.nodeSize[static_cast<std::size_t>(node)];
      nodeSize = nodeSize > 0.0 ? std::min(nodeSize, h) : h;
      division.nodes.push_back(node);
    } else {
      division.nodes.push_back(static_cast<std::int32_t>(divided.nodes.size()));
      divided.nodes.push_back(plan.asGiven ? plan.curve.points[i] : plan.curve.at(s));
      divided.nodeSize.push_back(h);
    }
  }
  divided.edges.push_back(std::move(division));
}

}  // namespace

DividedEdges divideEdges(const TriangleMesh& mesh, const Brep& brep, const SizeField& size,
                         const std::vector<std::int32_t>& minimumDivisions, const std::vector<std::uint8_t>& asGiven,
                         bool quadsOnly) {
  std::vector<EdgePlan> plans;
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const std::int32_t minimum = e < minimumDivisions.size() ? minimumDivisions[e] : 1;
    plans.push_back(planEdge(mesh, brep.edges[e], size, e, minimum));
    if (e < asGiven.size() && asGiven[e] != 0) keepPoints(plans.back());
  }
  if (quadsOnly) halveTinyTriangles(plans, brep);
  separateParallelEdges(plans, brep);
  levelSlits(mesh, brep, plans);

  DividedEdges divided;
  makeEven(plans, brep, quadsOnly);
  divided.oddFaces = oddFacesOf(plans, brep);
  balance(plans, mesh, brep);
  fillSmallLoops(plans, brep);
  assert(oddFacesOf(plans, brep) == divided.oddFaces);
  for (const BrepVertex& vertex : brep.vertices) {
    divided.nodes.push_back(mesh.positions[static_cast<std::size_t>(vertex.point)]);
    divided.nodeSize.push_back(0.0);
  }
  std::vector<std::vector<double>> places;
  for (const EdgePlan& plan : plans) {
    places.push_back(plan.asGiven ? plan.curve.arcLength : placeNodesOnCurve(plan, plan.count).arcLength);
  }
  alignSides(brep, plans, places);
  alignSlits(mesh, brep, plans, places);
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    placeNodes(divided, plans[e], brep.edges[e], std::move(places[e]));
  }
  for (double& h : divided.nodeSize) {
    if (!(h > 0.0)) h = size.base;
  }
  return divided;
}

}  // namespace qmcf
