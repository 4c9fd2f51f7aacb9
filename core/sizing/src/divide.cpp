#include "qmcf/sizing/divide.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "edge_groups.hpp"
#include "node_places.hpp"
#include "parity.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/sizing/edge_curve.hpp"

namespace qmcf {
namespace {

/// One edge on its way to whole divisions.
struct Plan : PlacedCurve {
  std::int32_t least = 1;
  std::int32_t count = 1;
  bool asGiven = false;  ///< The curve's own points are the nodes.
};

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

Plan planEdge(const TriangleMesh& mesh, const BrepEdge& edge, const SizeField& size, std::size_t e,
              std::int32_t minimum) {
  Plan plan;
  plan.curve = edgeCurve(mesh, edge);
  plan.sizes = sizesOf(size, edge, plan.curve, e);
  plan.integral.push_back(0.0);
  for (std::size_t i = 0; i + 1 < plan.sizes.value.size(); ++i) {
    const double length = plan.sizes.arcLength[i + 1] - plan.sizes.arcLength[i];
    const double density = 0.5 * (1.0 / plan.sizes.value[i] + 1.0 / plan.sizes.value[i + 1]);
    plan.integral.push_back(plan.integral.back() + length * density);
  }
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
void keepPoints(Plan& plan) {
  plan.asGiven = true;
  plan.count = plan.least = static_cast<std::int32_t>(plan.curve.points.size()) - 1;
}

/// Of edges between the same two vertices only one may stay undivided: they would be one edge of the mesh.
void separateParallelEdges(std::vector<Plan>& plans, const Brep& brep) {
  std::vector<std::array<std::int32_t, 3>> byEnds;  // Both ends, ascending, and the edge.
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const auto [first, last] = std::minmax(brep.edges[e].start, brep.edges[e].end);
    if (first != last) byEnds.push_back({first, last, static_cast<std::int32_t>(e)});
  }
  std::sort(byEnds.begin(), byEnds.end());
  for (std::size_t i = 0; i < byEnds.size();) {
    std::size_t end = i + 1;
    while (end < byEnds.size() && byEnds[end][0] == byEnds[i][0] && byEnds[end][1] == byEnds[i][1]) ++end;
    const auto planOf = [&](std::size_t k) -> Plan& { return plans[static_cast<std::size_t>(byEnds[k][2])]; };
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

/// Gives all edges of a group one number of divisions.
void settleGroups(std::vector<Plan>& plans, const std::vector<std::vector<std::int32_t>>& groups) {
  for (const auto& group : groups) {
    double sum = 0.0;
    std::int32_t least = 1;
    for (const std::int32_t e : group) {
      sum += plans[static_cast<std::size_t>(e)].wanted();
      least = std::max(least, plans[static_cast<std::size_t>(e)].least);
    }
    const double mean = sum / static_cast<double>(group.size());
    const auto count = std::max(least, static_cast<std::int32_t>(std::floor(mean + 0.5)));
    for (const std::int32_t e : group) {
      Plan& plan = plans[static_cast<std::size_t>(e)];
      if (!plan.asGiven) plan.count = count;
    }
  }
}

double misfit(double count, double wanted) {
  constexpr double kTiny = 1e-3;
  const double w = std::max(wanted, kTiny);
  return std::max(count / w, w / count) - 1.0;
}

/// A change of one division on all edges of `edges`, in the better direction.
struct Step {
  std::vector<std::int32_t> edges;
  std::int32_t by = 1;
  double cost = 0.0;
};

Step stepOf(const std::vector<Plan>& plans, std::vector<std::int32_t> edges) {
  double up = 0.0;
  double down = 0.0;
  bool canShrink = true;
  for (const std::int32_t e : edges) {
    const Plan& plan = plans[static_cast<std::size_t>(e)];
    up += misfit(plan.count + 1.0, plan.wanted());
    down += misfit(std::max(plan.count - 1.0, 0.5), plan.wanted());
    canShrink = canShrink && plan.count > plan.least;
  }
  return canShrink && down < up ? Step{std::move(edges), -1, down} : Step{std::move(edges), 1, up};
}

/// Per edge: the faces that use it an odd number of times.
std::vector<std::vector<std::int32_t>> oddUses(const Brep& brep) {
  std::vector<std::vector<std::int32_t>> uses(brep.edges.size());
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    const auto face = static_cast<std::int32_t>(f);
    for (const BrepLoop& loop : brep.faces[f].loops) {
      for (const Coedge& coedge : loop.coedges) {
        auto& of = uses[static_cast<std::size_t>(coedge.edge)];
        if (!of.empty() && of.back() == face) {
          of.pop_back();
        } else {
          of.push_back(face);
        }
      }
    }
  }
  return uses;
}

/// Makes the number of divisions around each face even wherever that is possible; returns the number of odd faces.
std::int64_t makeEven(std::vector<Plan>& plans, const Brep& brep,
                      const std::vector<std::vector<std::int32_t>>& groups) {
  // Worse than the change itself: opposite sides of a regular face that differ.
  constexpr double kBrokenGroup = 0.5;
  const auto uses = oddUses(brep);
  std::vector<bool> odd(brep.faces.size(), false);
  for (std::size_t e = 0; e < plans.size(); ++e) {
    if (plans[e].count % 2 == 0) continue;
    for (const std::int32_t f : uses[e]) odd[static_cast<std::size_t>(f)] = !odd[static_cast<std::size_t>(f)];
  }
  std::vector<bool> grouped(plans.size(), false);
  std::vector<Step> steps;
  for (const auto& group : groups) {
    for (const std::int32_t e : group) grouped[static_cast<std::size_t>(e)] = true;
    const bool isFixed = std::any_of(group.begin(), group.end(),
                                     [&](std::int32_t e) { return plans[static_cast<std::size_t>(e)].asGiven; });
    if (!isFixed) steps.push_back(stepOf(plans, group));
  }
  for (std::size_t e = 0; e < plans.size(); ++e) {
    if (plans[e].asGiven) continue;
    steps.push_back(stepOf(plans, {static_cast<std::int32_t>(e)}));
    if (grouped[e]) steps.back().cost += kBrokenGroup;
  }
  std::vector<ParityChange> changes;
  for (const Step& step : steps) {
    ParityChange change{{}, step.cost};
    for (const std::int32_t e : step.edges) {
      std::vector<std::int32_t> sum;
      const auto& of = uses[static_cast<std::size_t>(e)];
      std::set_symmetric_difference(change.faces.begin(), change.faces.end(), of.begin(), of.end(),
                                    std::back_inserter(sum));
      change.faces = std::move(sum);
    }
    changes.push_back(std::move(change));
  }
  const ParitySolution solution = solveParity(std::move(odd), changes);
  std::vector<std::int32_t> by(plans.size(), 0);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    if (!solution.apply[s]) continue;
    // An edge that changes with its group and on its own stays as it was.
    for (const std::int32_t e : steps[s].edges) {
      std::int32_t& of = by[static_cast<std::size_t>(e)];
      of = of == 0 ? steps[s].by : 0;
    }
  }
  for (std::size_t e = 0; e < plans.size(); ++e) plans[e].count += by[e];
  return solution.oddFaces;
}

/// A face inside a loop of two edges has no room for a triangle: loops get three at least, by steps that keep parity.
void fillSmallLoops(std::vector<Plan>& plans, const Brep& brep) {
  for (const BrepFace& face : brep.faces) {
    for (const BrepLoop& loop : face.loops) {
      std::int32_t sum = 0;
      std::size_t longest = 0;
      for (std::size_t c = 0; c < loop.coedges.size(); ++c) {
        const auto plan = [&](std::size_t i) -> const Plan& {
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

void placeNodes(DividedEdges& divided, const Plan& plan, const BrepEdge& edge) {
  EdgeDivision division;
  division.arcLength = plan.asGiven ? plan.curve.arcLength : placeNodesOnCurve(plan, plan.count).arcLength;
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
                         const std::vector<std::int32_t>& minimumDivisions, const std::vector<std::uint8_t>& asGiven) {
  std::vector<Plan> plans;
  std::vector<double> wanted;
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const std::int32_t minimum = e < minimumDivisions.size() ? minimumDivisions[e] : 1;
    plans.push_back(planEdge(mesh, brep.edges[e], size, e, minimum));
    if (e < asGiven.size() && asGiven[e] != 0) keepPoints(plans.back());
    wanted.push_back(std::max(plans.back().wanted(), static_cast<double>(plans.back().least)));
  }
  separateParallelEdges(plans, brep);
  const auto groups = oppositeEdges(brep, wanted);
  settleGroups(plans, groups);

  DividedEdges divided;
  divided.oddFaces = makeEven(plans, brep, groups);
  fillSmallLoops(plans, brep);
  for (const BrepVertex& vertex : brep.vertices) {
    divided.nodes.push_back(mesh.positions[static_cast<std::size_t>(vertex.point)]);
    divided.nodeSize.push_back(0.0);
  }
  for (std::size_t e = 0; e < brep.edges.size(); ++e) placeNodes(divided, plans[e], brep.edges[e]);
  for (double& h : divided.nodeSize) {
    if (!(h > 0.0)) h = size.base;
  }
  return divided;
}

}  // namespace qmcf
