#include "side_balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "face_uses.hpp"
#include "narrow_faces.hpp"
#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// A sum of divisions and what a regular grid makes it.
struct Row {
  std::vector<std::int32_t> edges;    ///< Ascending, each once.
  std::vector<std::int32_t> factors;  ///< Per edge, not zero.
  std::int32_t target = 0;
  std::int32_t face = kNone;
  double weight = 1.0;  ///< Cost of a unit that the sum differs from the target by.
};

bool isSmooth(const BrepLoop& loop) { return std::none_of(loop.coedges.begin(), loop.coedges.end(), isCorner); }

/// One outline with four corners more to the left than to the right, and holes with four more to the right.
bool isRectilinear(const BrepFace& face) {
  if (face.loops.empty()) return false;
  std::size_t outlines = 0;
  for (const BrepLoop& loop : face.loops) {
    const std::int32_t turn = turnOf(loop);
    if (turn != 4 && turn != -4) return false;
    outlines += turn == 4 ? 1 : 0;
  }
  return outlines == 1;
}

/// One loop with three corners: rows from all sides meet in a vertex with three elements.
bool isTriangular(const BrepFace& face) {
  if (face.loops.size() != 1) return false;
  const auto& coedges = face.loops[0].coedges;
  return turnOf(face.loops[0]) == 3 &&
         std::all_of(coedges.begin(), coedges.end(), [](const Coedge& c) { return c.cornerQuads <= 2; });
}

bool isRing(const BrepFace& face) {
  return face.loops.size() == 2 && isSmooth(face.loops[0]) && isSmooth(face.loops[1]);
}

constexpr double kFewRows = 2.0;

/// In a face of one or two rows there is no room for the two irregular vertices: they become triangles.
double weightOf(double rows) {
  constexpr double kNarrow = 5.0;
  return rows < kFewRows ? kNarrow : 1.0;
}

/// How many times as many divisions the sizes may ask for on one side of a row as on the other for the two to match.
/// Those of a narrow ring differ by its curvature alone: rows that end there leave elements with a straight corner.
double mostRatio(double rows, bool isRing) {
  constexpr double kRatio = 1.15;
  constexpr double kNarrowRatio = 1.7;
  constexpr double kRingRatio = 2.0;
  if (rows >= kFewRows) return kRatio;
  return isRing && rows < kOneRow ? kRingRatio : kNarrowRatio;
}

/// Whether the sizes let the two sides match: nearly as many divisions on both.
bool canMatch(const Row& row, const std::vector<EdgeCount>& edges, double ratio) {
  constexpr double kDifference = 1.0;
  double ahead = 0.0;
  double back = row.target;
  for (std::size_t i = 0; i < row.edges.size(); ++i) {
    const double wanted = std::max(edges[at(row.edges[i])].wanted, static_cast<double>(edges[at(row.edges[i])].least));
    (row.factors[i] > 0 ? ahead : back) += std::abs(row.factors[i]) * wanted;
  }
  return std::fabs(ahead - back) <= kDifference || std::max(ahead, back) <= ratio * std::min(ahead, back);
}

/// Collects the rows of the faces.
class RowFinder {
 public:
  RowFinder(const TriangleMesh& mesh, const Brep& brep, const std::vector<EdgeCount>& edges)
      : mesh_(mesh), brep_(brep), edges_(edges), sums_(brep.edges.size(), 0) {
    for (const EdgeCount& edge : edges) wanted_.push_back(edge.wanted);
  }

  std::vector<Row> find() {
    for (std::size_t f = 0; f < brep_.faces.size(); ++f) {
      face_ = static_cast<std::int32_t>(f);
      acrossFace_ = rowsAcross(brep_, brep_.faces[f], wanted_);
      const bool isNarrow = acrossFace_ < kOneRow;
      if (isNarrow && addTapered(brep_.faces[f])) continue;
      const BrepFace face = isNarrow ? withEnds(brep_.faces[f]) : brep_.faces[f];
      if (isNarrow) addEnds(face);
      if (isRectilinear(face)) {
        for (const BrepLoop& loop : face.loops) addLoop(loop);
        if (face.loops.size() == 2 && acrossFace_ < kFewRows) addFrame(face);
      } else if (isTriangular(face)) {
        addTriangle(face.loops[0]);
      } else if (isRing(face)) {
        add(face.loops[0].coedges, 1);
        add(face.loops[1].coedges, -1);
        keepIfItCanMatch(take(0), true);
      }
    }
    return std::move(rows_);
  }

 private:
  void add(std::span<const Coedge> coedges, std::int32_t factor) {
    for (const Coedge& coedge : coedges) {
      std::int32_t& sum = sums_[at(coedge.edge)];
      if (sum == 0) touched_.push_back(coedge.edge);
      sum += factor;
    }
  }

  /// Makes a row of what was added.
  Row take(std::int32_t target) {
    Row row;
    row.face = face_;
    row.target = target;
    row.weight = weightOf(acrossFace_);
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    for (const std::int32_t edge : touched_) {
      if (sums_[at(edge)] == 0) continue;
      row.edges.push_back(edge);
      row.factors.push_back(sums_[at(edge)]);
      sums_[at(edge)] = 0;
    }
    touched_.clear();
    return row;
  }

  void keepIfItCanMatch(Row row, bool isRing = false) {
    if (!row.edges.empty() && canMatch(row, edges_, mostRatio(acrossFace_, isRing))) rows_.push_back(std::move(row));
  }

  /// Divisions one way and back, along both axes.
  void addLoop(const BrepLoop& loop) {
    for (std::int32_t axis = 0; axis < 2; ++axis) {
      std::int32_t direction = 0;
      for (const Coedge& coedge : loop.coedges) {
        direction += 2 - coedge.cornerQuads + 4;
        if (direction % 2 == axis) add({&coedge, 1}, direction % 4 < 2 ? 1 : -1);
      }
      keepIfItCanMatch(take(0));
    }
  }

  /// The four sides of an outline and those of a hole one row inside: each is two elements longer than the other.
  void addFrame(const BrepFace& face) {
    const bool isFirst = turnOf(face.loops[0]) == 4;
    const auto outer = fourSidesOf(face.loops[isFirst ? 0 : 1], 1);
    const auto inner = fourSidesOf(face.loops[isFirst ? 1 : 0], 3);
    if (!outer || !inner) return;
    // The hole is run through the other way round. Its sides end where those of the outline start.
    double least = std::numeric_limits<double>::infinity();
    std::size_t shift = 0;
    for (std::size_t s = 0; s < 4; ++s) {
      double sum = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        sum += distance(cornerOf((*outer)[i]), cornerOf((*inner)[(s + 5 - i) % 4]));
      }
      if (sum < least) {
        least = sum;
        shift = s;
      }
    }
    for (std::size_t i = 0; i < 4; ++i) {
      add((*outer)[i], 1);
      add((*inner)[(shift + 4 - i) % 4], -1);
      keepIfItCanMatch(take(2));
    }
  }

  /// A face of one row between a tip and another or an end: as many divisions on one side as on the other. Returns
  /// false for other faces.
  bool addTapered(const BrepFace& face) {
    const std::optional<RowSides> sides = taperedSides(face);
    if (!sides) return false;
    add(sides->one, 1);
    add(sides->other, -1);
    keepIfItCanMatch(take(0));
    return true;
  }

  [[nodiscard]] double wantedOn(const std::vector<Coedge>& side) const {
    double sum = 0.0;
    for (const Coedge& coedge : side) sum += wanted_[at(coedge.edge)];
    return sum;
  }

  /// The ends of a long single row have one element, whatever their sizes: with two the row would end in triangles.
  void addEnds(const BrepFace& face) {
    constexpr double kLong = 8.0;
    constexpr double kMostWanted = 2.5;
    const std::optional<RowSides> sides = fourSides(brep_, face);
    if (!sides) return;
    for (const std::vector<Coedge>& end : sides->ends) {
      const double wanted = wantedOn(end);
      if (wanted > kMostWanted || std::min(wantedOn(sides->one), wantedOn(sides->other)) < kLong * wanted) continue;
      add(end, 1);
      Row row = take(1);
      if (!row.edges.empty()) rows_.push_back(std::move(row));
    }
  }

  /// A side as long as the two others together has the vertex with three elements on it: one of its elements has a
  /// straight corner. Two divisions less, and it lies a row inside.
  void addTriangle(const BrepLoop& loop) {
    constexpr std::int32_t kInside = 2;
    constexpr double kNear = 1.5;
    std::vector<Coedge> fromCorner = loop.coedges;
    std::rotate(fromCorner.begin(), std::find_if(fromCorner.begin(), fromCorner.end(), isCorner), fromCorner.end());
    for (std::size_t longest = 0; longest < 3; ++longest) {
      double wanted = 0.0;
      std::size_t corners = 0;
      for (const Coedge& coedge : fromCorner) {
        if (isCorner(coedge)) ++corners;
        const std::int32_t factor = corners == longest + 1 ? -1 : 1;
        wanted += factor * edges_[at(coedge.edge)].wanted;
        add({&coedge, 1}, factor);
      }
      Row row = take(kInside);
      if (!row.edges.empty() && std::fabs(wanted - kInside) < kNear) rows_.push_back(std::move(row));
    }
  }

  /// The sides between the four corners of a loop, so many quadrilaterals in each.
  [[nodiscard]] static std::optional<std::vector<std::vector<Coedge>>> fourSidesOf(const BrepLoop& loop,
                                                                                   std::int32_t cornerQuads) {
    std::vector<std::vector<Coedge>> sides = sidesOf(loop);
    const auto fits = [=](const std::vector<Coedge>& side) { return side.front().cornerQuads == cornerQuads; };
    if (sides.size() != 4 || !std::all_of(sides.begin(), sides.end(), fits)) return std::nullopt;
    return sides;
  }

  /// Where a side starts.
  [[nodiscard]] const Vec3& cornerOf(const std::vector<Coedge>& side) const {
    const BrepEdge& edge = brep_.edges[at(side.front().edge)];
    const std::int32_t vertex = side.front().reversed ? edge.end : edge.start;
    return mesh_.positions[at(brep_.vertices[at(vertex)].point)];
  }

  const TriangleMesh& mesh_;
  const Brep& brep_;
  const std::vector<EdgeCount>& edges_;
  std::vector<double> wanted_;  ///< Per edge.
  std::vector<Row> rows_;
  std::int32_t face_ = kNone;
  double acrossFace_ = 0.0;         ///< Elements across the face.
  std::vector<std::int32_t> sums_;  ///< Per edge: the factor of the row being made.
  std::vector<std::int32_t> touched_;
};

std::int32_t mismatchOf(const Row& row, const std::vector<EdgeCount>& edges) {
  std::int32_t value = -row.target;
  for (std::size_t i = 0; i < row.edges.size(); ++i) value += row.factors[i] * edges[at(row.edges[i])].count;
  return value;
}

/// Cost of an edge that departs from what the sizes ask for, in units of a pair of irregular vertices.
double departure(const EdgeCount& edge, std::int32_t count) {
  constexpr double kStretch = 4.0;
  constexpr double kLeastWanted = 0.5;
  const double wanted = std::max(edge.wanted, kLeastWanted);
  const double stretch = math::log(count / wanted);
  return kStretch * wanted * stretch * stretch;
}

/// An edge changed by one.
struct Change {
  std::int32_t edge = kNone;
  std::int32_t by = 0;

  [[nodiscard]] std::size_t id() const { return 2 * at(edge) + (by > 0 ? 1 : 0); }
};

/// One as a step of a walk over the faces. The same change the other way is another step: the walk goes on elsewhere.
struct Step : Change {
  std::int32_t to = kNone;  ///< The face that it leads to: index into the faces beside the edge.

  [[nodiscard]] std::size_t stepId() const { return 2 * id() + static_cast<std::size_t>(to); }
};

class Balance {
 public:
  Balance(const TriangleMesh& mesh, const Brep& brep, std::vector<EdgeCount>& edges)
      : edges_(edges), uses_(oddUses(brep)), rows_(RowFinder(mesh, brep, edges).find()), terms_(brep.edges.size()) {
    ground_ = static_cast<std::int32_t>(brep.faces.size());
    changing_.resize(brep.faces.size() + 1);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (edges_[e].fixed || uses_[e].empty() || uses_[e].size() > 2) continue;
      if (uses_[e].size() == 1) uses_[e].push_back(ground_);
      for (const std::int32_t face : uses_[e]) changing_[at(face)].push_back(static_cast<std::int32_t>(e));
    }
    rowsOfFace_.resize(brep.faces.size() + 1);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      value_.push_back(mismatchOf(rows_[r], edges_));
      rowsOfFace_[at(rows_[r].face)].push_back(r);
      for (std::size_t i = 0; i < rows_[r].edges.size(); ++i) {
        terms_[at(rows_[r].edges[i])].push_back({rows_[r].face, r, rows_[r].factors[i]});
      }
    }
    label_.resize(4 * edges_.size());
    cost_.resize(2 * edges_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) price(static_cast<std::int32_t>(e));
  }

  void run() {
    constexpr int kPasses = 6;
    for (int pass = 0; pass < kPasses; ++pass) {
      bool improved = false;
      for (std::int32_t face = 0; face < ground_; ++face) {
        while (hasMismatch(face) && improve(face)) improved = true;
      }
      if (!improved || budget_ < 0) return;
    }
  }

 private:
  struct Term {
    std::int32_t face = kNone;
    std::size_t row = 0;
    std::int32_t factor = 0;
  };
  /// The cheapest known walk that ends with a step.
  struct Label {
    double cost = std::numeric_limits<double>::infinity();
    Step before;  ///< None: the walk starts here.
    bool queued = false;
  };

  [[nodiscard]] bool hasMismatch(std::int32_t face) const {
    const auto& rows = rowsOfFace_[at(face)];
    return std::any_of(rows.begin(), rows.end(), [&](std::size_t r) { return value_[r] != 0; });
  }

  [[nodiscard]] std::int32_t beyond(std::int32_t edge, std::int32_t face) const {
    return uses_[at(edge)][0] == face ? uses_[at(edge)][1] : uses_[at(edge)][0];
  }

  [[nodiscard]] bool allowed(const Change& change) const {
    const EdgeCount& edge = edges_[at(change.edge)];
    return change.by > 0 || edge.count > edge.least;
  }

  [[nodiscard]] double costOf(const Change& change) const { return cost_[change.id()]; }

  /// Finds out what the changes of an edge cost now.
  void price(std::int32_t edge) {
    const EdgeCount& now = edges_[at(edge)];
    for (const Change change : {Change{edge, -1}, Change{edge, 1}}) {
      if (allowed(change)) cost_[change.id()] = departure(now, now.count + change.by) - departure(now, now.count);
    }
  }

  /// Calls visit for each change of an edge at a face that a walk of this cost may go on with.
  template <class Visit>
  void forEachChange(std::int32_t face, double cost, Visit visit) {
    if (face != ground_) {
      budget_ -= static_cast<std::int64_t>(changing_[at(face)].size());
      for (const std::int32_t edge : changing_[at(face)]) {
        for (const std::int32_t by : {-1, 1}) {
          if (allowed({edge, by})) visit(Change{edge, by});
        }
      }
      return;
    }
    // It has all open edges of the part, and no rows: what is too costly there stays so.
    if (groundChanges_.empty()) sortGround();
    for (const Change& change : groundChanges_) {
      --budget_;
      if (cost + costOf(change) >= -kLeastGain) return;
      visit(change);
    }
  }

  /// Changes beyond the open edges, the cheapest first.
  void sortGround() {
    for (const std::int32_t edge : changing_[at(ground_)]) {
      for (const std::int32_t by : {-1, 1}) {
        if (allowed({edge, by})) groundChanges_.push_back({edge, by});
      }
    }
    std::sort(groundChanges_.begin(), groundChanges_.end(), [this](const Change& a, const Change& b) {
      return costOf(a) != costOf(b) ? costOf(a) < costOf(b) : a.id() < b.id();
    });
  }

  /// What it costs to make a change twice; infinity if that is not allowed.
  [[nodiscard]] double costOfTwo(const Change& change) const {
    const EdgeCount& edge = edges_[at(change.edge)];
    const std::int32_t count = edge.count + 2 * change.by;
    if (count < edge.least) return std::numeric_limits<double>::infinity();
    double cost = departure(edge, count) - departure(edge, edge.count);
    for (const Term& term : terms_[at(change.edge)]) {
      const std::int32_t after = value_[term.row] + 2 * change.by * term.factor;
      cost += rows_[term.row].weight * (std::abs(after) - std::abs(value_[term.row]));
    }
    return cost;
  }

  /// What two changes do to the mismatch of a face.
  [[nodiscard]] double costIn(std::int32_t face, const Change& a, const Change& b) const {
    double cost = 0.0;
    const auto unitsOf = [&](const Change& change, std::size_t row) {
      std::int32_t units = 0;
      for (const Term& term : terms_[at(change.edge)]) {
        if (term.row == row) units += term.factor * change.by;
      }
      return units;
    };
    const auto add = [&](std::size_t row) {
      const std::int32_t after = value_[row] + unitsOf(a, row) + unitsOf(b, row);
      cost += rows_[row].weight * (std::abs(after) - std::abs(value_[row]));
    };
    for (const Term& term : terms_[at(a.edge)]) {
      if (term.face == face) add(term.row);
    }
    for (const Term& term : terms_[at(b.edge)]) {
      if (term.face != face) continue;
      const auto& first = terms_[at(a.edge)];
      if (std::none_of(first.begin(), first.end(), [&](const Term& t) { return t.row == term.row; })) add(term.row);
    }
    return cost;
  }

  /// Over an edge away from one of the faces beside it.
  [[nodiscard]] Step stepFrom(std::int32_t face, const Change& change) const {
    return {change, uses_[at(change.edge)][0] == face ? 1 : 0};
  }

  [[nodiscard]] std::int32_t faceAfter(const Step& step) const { return uses_[at(step.edge)][at(step.to)]; }

  [[nodiscard]] bool passes(const Step& end, std::int32_t face, std::int32_t start) const {
    if (face == start) return true;
    for (Step s = end; s.edge != kNone; s = label_[s.stepId()].before) {
      if (faceAfter(s) == face) return true;
    }
    return false;
  }

  /// Whether a walk passes each face once. It may not: the way to a step that it goes on from can have changed since.
  [[nodiscard]] bool passesOnce(const Step& end) {
    passed_.clear();
    for (Step s = end; s.edge != kNone; s = label_[s.stepId()].before) passed_.push_back(faceAfter(s));
    std::sort(passed_.begin(), passed_.end());
    return std::adjacent_find(passed_.begin(), passed_.end()) == passed_.end();
  }

  /// Applies the best change that lowers the cost: a closed walk that starts in `face`, or one of its edges by two,
  /// which leaves the parity of both faces beside it as it is.
  bool improve(std::int32_t face) {
    double best = -kLeastGain;
    std::vector<Change> bestWalk;
    for (const std::int32_t edge : changing_[at(face)]) {
      for (const std::int32_t by : {-1, 1}) {
        const Change last{edge, by};
        if (allowed(last)) search(face, last, best, bestWalk);
        if (costOfTwo(last) >= best) continue;
        best = costOfTwo(last);
        bestWalk = {last, last};
      }
    }
    for (const Change& change : bestWalk) {
      edges_[at(change.edge)].count += change.by;
      price(change.edge);
      groundChanges_.clear();
      for (const Term& term : terms_[at(change.edge)]) value_[term.row] += term.factor * change.by;
    }
    return !bestWalk.empty();
  }

  /// Closed walks from `start` over other faces back to it by the change `last`. Of a walk that lowers the cost some
  /// rotation has no beginning that raises it, so that such beginnings need not be followed.
  void search(std::int32_t start, const Change& last, double& best, std::vector<Change>& bestWalk) {
    std::vector<Step> queue;
    std::vector<Step> touched;
    const auto reach = [&](const Step& before, const Step& step, double cost) {
      Label& label = label_[step.stepId()];
      if (cost >= label.cost - kLeastGain || cost >= -kLeastGain) return;
      if (before.edge != kNone && passes(before, faceAfter(step), start)) return;
      if (label.cost == std::numeric_limits<double>::infinity()) touched.push_back(step);
      label.cost = cost;
      label.before = before;
      if (!label.queued) queue.push_back(step);
      label.queued = true;
    };
    const std::int32_t lastFace = beyond(last.edge, start);
    const double lastCost = costOf(last);
    for (const std::int32_t edge : changing_[at(start)]) {
      if (edge == last.edge) continue;
      for (const std::int32_t by : {-1, 1}) {
        const Change change{edge, by};
        if (allowed(change)) reach({}, stepFrom(start, change), costIn(start, last, change) + costOf(change));
      }
    }
    for (std::size_t i = 0; i < queue.size() && budget_ > 0; ++i) {
      const Step step = queue[i];
      label_[step.stepId()].queued = false;
      const double cost = label_[step.stepId()].cost;
      const std::int32_t face = faceAfter(step);
      if (face == lastFace) {
        const double total = cost + lastCost + (face == ground_ ? 0.0 : costIn(face, step, last));
        if (total < best && passesOnce(step)) {
          best = total;
          bestWalk = {last};
          for (Step s = step; s.edge != kNone; s = label_[s.stepId()].before) bestWalk.push_back(s);
        }
      }
      forEachChange(face, cost, [&](const Change& next) {
        if (next.edge == step.edge || next.edge == last.edge) return;
        const double inFace = face == ground_ ? 0.0 : costIn(face, step, next);
        reach(step, stepFrom(face, next), cost + inFace + costOf(next));
      });
    }
    for (const Step& step : touched) label_[step.stepId()] = {};
  }

  static constexpr double kLeastGain = 1e-6;

  std::vector<EdgeCount>& edges_;
  std::vector<std::vector<std::int32_t>> uses_;  ///< Per edge that may change: the two faces beside it.
  std::vector<Row> rows_;
  std::vector<std::vector<Term>> terms_;  ///< Per edge.
  std::vector<std::int32_t> value_;       ///< Per row.
  std::vector<std::vector<std::size_t>> rowsOfFace_;
  std::vector<std::vector<std::int32_t>> changing_;  ///< Per face, and beyond the open edges: edges that may change.
  std::int32_t ground_ = 0;                          ///< Stands for a face beyond the open edges.
  std::vector<Change> groundChanges_;                ///< As sortGround() left them; empty: out of date.
  std::vector<Label> label_;                         ///< Per step.
  std::vector<std::int32_t> passed_;                 ///< Scratch of passesOnce().
  std::vector<double> cost_;                         ///< Per change that is allowed.
  std::int64_t budget_ = 10'000'000;
};

}  // namespace

void balanceSides(const TriangleMesh& mesh, const Brep& brep, std::vector<EdgeCount>& edges) {
  Balance(mesh, brep, edges).run();
}

}  // namespace qmcf
