#include "node_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

// Places are measured in divisions: the integral of ds / h, scaled such that the whole edge is `count`.
constexpr double kReach = 0.5;      // How far a node may go from its equal part,
constexpr double kStopReach = 0.7;  // and to a stop.
constexpr double kShortest = 0.3;   // Of a division.
constexpr int kSteps = 4;           // Places tried on each side of the equal part.
/// A point of the polygon is tried when it turns by more than this; the sharpest ones of a part where there are many.
constexpr double kLeastTurn = math::kPi / 18.0;
constexpr std::size_t kMostCorners = 8;
/// An edge that nowhere turns by more than this is straight.
constexpr double kStraightTurn = math::kPi / 360.0;
/// Weights against the square of a division's relative error of length: a sagitta of a tenth counts as an error of 0.7.
constexpr double kSagittaWeight = 50.0;
constexpr double kStopWeight = 1.0;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// A place where a node may be, and the cheapest way to get there.
struct Candidate {
  double at = 0.0;  ///< In divisions.
  double s = 0.0;   ///< Arc length.
  double cost = kNever;
  std::size_t before = 0;  ///< Candidate of the node before.
};

double turnAt(const EdgeCurve& curve, std::size_t i) {
  const Vec3 before = curve.points[i] - curve.points[i - 1];
  const Vec3 after = curve.points[i + 1] - curve.points[i];
  return math::atan2(norm(cross(before, after)), dot(before, after));
}

double squaredDistanceToChord(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length = squaredNorm(along);
  const double t = length > 0.0 ? std::clamp(dot(p - a, along) / length, 0.0, 1.0) : 0.0;
  return squaredNorm(a + along * t - p);
}

class Placement {
 public:
  Placement(const PlacedCurve& placed, std::int32_t count)
      : placed_(placed), count_(static_cast<std::size_t>(count)), scale_(count / placed.wanted()) {
    findCorners();
    nodes_.resize(count_ + 1);
    nodes_.front().push_back({0.0, 0.0, 0.0, 0});
    for (std::size_t k = 1; k < count_; ++k) addCandidates(k);
    nodes_.back().push_back({static_cast<double>(count_), placed.curve.length(), kNever, 0});
  }

  NodePlaces solve() {
    for (std::size_t k = 1; k <= count_; ++k) {
      for (Candidate& to : nodes_[k]) {
        for (std::size_t i = 0; i < nodes_[k - 1].size(); ++i) {
          const Candidate& from = nodes_[k - 1][i];
          const double length = to.at - from.at;
          if (length < kShortest || from.cost + (length - 1.0) * (length - 1.0) >= to.cost) continue;
          const double cost = from.cost + costOf(from, to);
          if (cost < to.cost) {
            to.cost = cost;
            to.before = i;
          }
        }
      }
    }
    NodePlaces places;
    places.arcLength.resize(count_ + 1);
    std::size_t i = 0;
    for (std::size_t k = count_; k > 0; --k) {
      const Candidate& to = nodes_[k][i];
      places.arcLength[k] = to.s;
      places.sagitta = std::max(places.sagitta, sagitta(nodes_[k - 1][to.before], to));
      i = to.before;
    }
    places.arcLength.front() = 0.0;
    return places;
  }

 private:
  struct Corner {
    double at;
    double s;
    double turn;
    bool isStop;

    [[nodiscard]] double reach() const { return isStop ? kStopReach : kReach; }
  };

  [[nodiscard]] double placeOf(double s) const {
    return scale_ * interpolate(placed_.sizes.arcLength, placed_.integral, s);
  }

  void findCorners() {
    std::size_t stop = 0;
    for (std::size_t i = 1; i + 1 < placed_.curve.points.size(); ++i) {
      const double s = placed_.curve.arcLength[i];
      while (stop < placed_.stops.size() && static_cast<std::size_t>(placed_.stops[stop]) < i) ++stop;
      const bool isStop = stop < placed_.stops.size() && static_cast<std::size_t>(placed_.stops[stop]) == i;
      if (isStop) stops_.push_back(s);
      const double turn = turnAt(placed_.curve, i);
      isStraight_ = isStraight_ && turn < kStraightTurn && !isStop;
      if (turn >= kLeastTurn || isStop) corners_.push_back({placeOf(s), s, turn, isStop});
    }
    if (placed_.sought.empty()) return;
    isStraight_ = false;
    for (const double s : placed_.sought) {
      stops_.push_back(s);
      corners_.push_back({placeOf(s), s, 0.0, true});
    }
    std::sort(stops_.begin(), stops_.end());
    std::sort(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) { return a.s < b.s; });
  }

  /// The equal part first: where nothing speaks for another place, the first of the cheapest is taken.
  void addCandidates(std::size_t k) {
    const auto middle = static_cast<double>(k);
    const auto add = [&](double at) {
      nodes_[k].push_back({at, interpolate(placed_.integral, placed_.sizes.arcLength, at / scale_), kNever, 0});
    };
    add(middle);
    while (firstCorner_ < corners_.size() && corners_[firstCorner_].at <= middle - kStopReach) ++firstCorner_;
    std::vector<Corner> near;
    for (std::size_t i = firstCorner_; i < corners_.size() && corners_[i].at < middle + kStopReach; ++i) {
      if (std::fabs(corners_[i].at - middle) < corners_[i].reach()) near.push_back(corners_[i]);
    }
    // Stops come before all others.
    std::sort(near.begin(), near.end(), [](const Corner& a, const Corner& b) {
      if (a.isStop != b.isStop) return a.isStop;
      return a.turn != b.turn ? a.turn > b.turn : a.s < b.s;
    });
    if (near.size() > kMostCorners) near.resize(kMostCorners);
    for (const Corner& corner : near) nodes_[k].push_back({corner.at, corner.s, kNever, 0});
    if (isStraight_) return;  // Nothing to move for.
    for (int step = 1; step <= kSteps; ++step) {
      add(middle - kReach * step / kSteps);
      add(middle + kReach * step / kSteps);
    }
  }

  [[nodiscard]] double sagitta(const Candidate& from, const Candidate& to) const {
    const EdgeCurve& curve = placed_.curve;
    const Vec3 a = curve.at(from.s);
    const Vec3 b = curve.at(to.s);
    double farthest = 0.0;
    const auto first = std::upper_bound(curve.arcLength.begin(), curve.arcLength.end(), from.s);
    for (auto it = first; it != curve.arcLength.end() && *it < to.s; ++it) {
      const auto i = static_cast<std::size_t>(it - curve.arcLength.begin());
      farthest = std::max(farthest, squaredDistanceToChord(curve.points[i], a, b));
    }
    if (!(farthest > 0.0)) return 0.0;
    const double h = interpolate(placed_.sizes.arcLength, placed_.sizes.value, 0.5 * (from.s + to.s));
    return std::sqrt(farthest) / std::min(h, placed_.chordSize);
  }

  [[nodiscard]] double costOf(const Candidate& from, const Candidate& to) const {
    const double error = to.at - from.at - 1.0;
    const double off = sagitta(from, to);
    const auto passed = std::upper_bound(stops_.begin(), stops_.end(), from.s);
    const auto reached = std::lower_bound(stops_.begin(), stops_.end(), to.s);
    const double missed = passed < reached ? static_cast<double>(reached - passed) : 0.0;
    return error * error + kSagittaWeight * off * off + kStopWeight * missed;
  }

  const PlacedCurve& placed_;
  std::size_t count_;
  double scale_;
  std::vector<Corner> corners_;
  std::vector<double> stops_;  ///< Arc lengths.
  std::size_t firstCorner_ = 0;
  bool isStraight_ = true;
  std::vector<std::vector<Candidate>> nodes_;  ///< Per node: the candidates for its place.
};

}  // namespace

NodePlaces placeNodesOnCurve(const PlacedCurve& placed, std::int32_t count) { return Placement(placed, count).solve(); }

}  // namespace qmcf
