#include "align_sides.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "narrow_faces.hpp"
#include "qmcf/sizing/slits.hpp"

namespace qmcf {
namespace {

/// Slits up to so many times as wide in the middle as where nodes are across from each other have as many divisions on
/// both sides.
constexpr double kHardlyOpen = 10.0;

/// One side of a narrow face, from one end to the other, as its edges lie on it.
struct Side {
  struct Piece {
    std::size_t edge = 0;
    bool reversed = false;
    double start = 0.0;  ///< Arc length along the side.
    double length = 0.0;
  };
  std::vector<Piece> pieces;
  double length = 0.0;

  Side(const std::vector<Coedge>& coedges, bool backwards, const std::vector<EdgePlan>& plans) {
    for (std::size_t i = 0; i < coedges.size(); ++i) {
      const Coedge& coedge = coedges[backwards ? coedges.size() - 1 - i : i];
      const auto e = static_cast<std::size_t>(coedge.edge);
      pieces.push_back({e, coedge.reversed != backwards, length, plans[e].curve.length()});
      length += pieces.back().length;
    }
  }

  /// From a share of the side's length to the edge's own arc length; outside of the edge: nothing.
  [[nodiscard]] std::optional<double> onPiece(const Piece& piece, double share) const {
    const double s = share * length - piece.start;
    if (!(s > 0.0) || !(s < piece.length)) return std::nullopt;
    return piece.reversed ? piece.length - s : s;
  }

  [[nodiscard]] double shareOf(const Piece& piece, double arcLength) const {
    return (piece.start + (piece.reversed ? piece.length - arcLength : arcLength)) / length;
  }
};

std::vector<EdgeCurve> curvesOf(const std::vector<EdgePlan>& plans) {
  std::vector<EdgeCurve> curves;
  curves.reserve(plans.size());
  for (const EdgePlan& plan : plans) curves.push_back(plan.curve);
  return curves;
}

/// Places the nodes of an edge anew, where they may be at these places, too.
void seekOnEdge(std::size_t edge, const std::vector<double>& sought, std::vector<EdgePlan>& plans,
                std::vector<std::vector<double>>& places) {
  EdgePlan& plan = plans[edge];
  if (sought.empty() || plan.asGiven || plan.count < 2) return;
  plan.sought.insert(plan.sought.end(), sought.begin(), sought.end());
  std::sort(plan.sought.begin(), plan.sought.end());
  places[edge] = placeNodesOnCurve(plan, plan.count).arcLength;
}

/// Places the nodes of a side anew, where it may be across from these shares of its length.
void seek(const Side& side, const std::vector<double>& shares, std::vector<EdgePlan>& plans,
          std::vector<std::vector<double>>& places) {
  for (const Side::Piece& piece : side.pieces) {
    std::vector<double> sought;
    for (const double share : shares) {
      if (const auto s = side.onPiece(piece, share)) sought.push_back(*s);
    }
    seekOnEdge(piece.edge, sought, plans, places);
  }
}

}  // namespace

void alignSides(const Brep& brep, std::vector<EdgePlan>& plans, std::vector<std::vector<double>>& places) {
  std::vector<double> wanted;
  for (const EdgePlan& plan : plans) wanted.push_back(plan.wanted());
  for (const BrepFace& face : brep.faces) {
    if (rowsAcross(brep, face, wanted) >= kOneRow) continue;
    std::optional<RowSides> sides = taperedSides(face);
    if (!sides) sides = fourSides(brep, withEnds(face));
    if (!sides) continue;
    const Side one(sides->one, false, plans);
    const Side other(sides->other, true, plans);
    // The side of more pieces, each with its ends where they are, leads.
    const bool isOneFirst = one.pieces.size() >= other.pieces.size();
    const Side& leader = isOneFirst ? one : other;
    const Side& follower = isOneFirst ? other : one;
    std::vector<double> ends;
    for (const Side::Piece& piece : follower.pieces) {
      if (piece.start > 0.0) ends.push_back(piece.start / follower.length);
    }
    seek(leader, ends, plans, places);
    std::vector<double> nodes;
    for (const Side::Piece& piece : leader.pieces) {
      for (const double s : places[piece.edge]) nodes.push_back(leader.shareOf(piece, s));
    }
    std::sort(nodes.begin(), nodes.end());
    seek(follower, nodes, plans, places);
  }
}

void levelSlits(const TriangleMesh& mesh, const Brep& brep, std::vector<EdgePlan>& plans) {
  const std::vector<EdgeCurve> curves = curvesOf(plans);
  const double width = kHardlyOpen * slitWidth(mesh);
  for (const auto& [one, other] : findSlits(brep, curves, width)) {
    EdgePlan& first = plans[static_cast<std::size_t>(one)];
    EdgePlan& second = plans[static_cast<std::size_t>(other)];
    const double middle = 0.5 * first.curve.length();
    const bool isOpen = std::fabs(first.curve.length() - second.curve.length()) > width ||
                        !acrossSlit(second.curve, first.curve.at(middle), width);
    if (isOpen || first.asGiven || second.asGiven) continue;
    const std::int32_t count = std::max(first.count, second.count);
    first.count = first.least = count;
    second.count = second.least = count;
  }
}

void alignSlits(const TriangleMesh& mesh, const Brep& brep, std::vector<EdgePlan>& plans,
                std::vector<std::vector<double>>& places) {
  const std::vector<EdgeCurve> curves = curvesOf(plans);
  const double width = slitWidth(mesh);
  for (const auto& [one, other] : findSlits(brep, curves, width)) {
    const bool isOneFirst =
        places[static_cast<std::size_t>(one)].size() >= places[static_cast<std::size_t>(other)].size();
    const auto leader = static_cast<std::size_t>(isOneFirst ? one : other);
    const auto follower = static_cast<std::size_t>(isOneFirst ? other : one);
    std::vector<double> sought;
    for (const double s : places[leader]) {
      if (const auto across = acrossSlit(curves[follower], curves[leader].at(s), width)) sought.push_back(*across);
    }
    seekOnEdge(follower, sought, plans, places);
  }
}

}  // namespace qmcf
