#include "polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "qmcf/base/math.hpp"

namespace qmcf::property {
namespace {

using Loop = std::vector<Point>;

double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

Point onCircle(double radius, double angle) { return {radius * math::cos(angle), radius * math::sin(angle)}; }

/// Spikes and dents around a centre.
Loop star(Random& random) {
  const int corners = pick(random, 3, 18);
  const double deepest = random.uniform(0.15, 0.95);
  const double start = random.uniform(0.0, 2.0 * math::kPi);
  Loop loop;
  for (int i = 0; i < corners; ++i) {
    // No two neighbours further apart than half a turn as seen from the centre.
    const double jitter = corners > 3 ? random.uniform(-0.3, 0.3) : 0.0;
    loop.push_back(onCircle(random.uniform(deepest, 1.0), start + 2.0 * math::kPi * (i + jitter) / corners));
  }
  return loop;
}

/// A closed curve without corners.
Loop blob(Random& random) {
  const int points = pick(random, 24, 72);
  std::array<double, 4> amplitude{};
  std::array<double, 4> phase{};
  for (std::size_t k = 0; k < amplitude.size(); ++k) {
    amplitude[k] = random.uniform(0.0, 0.16);
    phase[k] = random.uniform(0.0, 2.0 * math::kPi);
  }
  Loop loop;
  for (int i = 0; i < points; ++i) {
    const double angle = 2.0 * math::kPi * i / points;
    double radius = 0.6;
    for (std::size_t k = 0; k < amplitude.size(); ++k) {
      radius += 0.6 * amplitude[k] * math::cos(static_cast<double>(k + 1) * angle + phase[k]);
    }
    loop.push_back(onCircle(radius, angle));
  }
  return loop;
}

/// Columns side by side, of any height and depth: steps, slots and narrow necks, all angles right.
Loop comb(Random& random) {
  const int columns = pick(random, 1, 7);
  std::vector<double> left{0.0};
  for (int i = 0; i < columns; ++i) left.push_back(left.back() + pickLogarithmic(random, 0.05, 1.0));
  const double width = left.back();
  Loop lower;
  Loop upper;
  for (int i = 0; i < columns; ++i) {
    const auto column = static_cast<std::size_t>(i);
    const double bottom = -pickLogarithmic(random, 0.01, 0.7);
    const double top = pickLogarithmic(random, 0.01, 0.7);
    for (const double x : {left[column], left[column + 1]}) {
      lower.push_back({1.4 * x / width - 0.7, bottom});
      upper.push_back({1.4 * x / width - 0.7, top});
    }
  }
  lower.insert(lower.end(), upper.rbegin(), upper.rend());
  return lower;
}

/// Two arcs between the same two points, which are cusps when the arcs bend alike.
Loop crescent(Random& random) {
  const double low = random.uniform(-0.9, 0.6);
  const double high = low + random.uniform(0.06, 0.9 - low);
  const int points = pick(random, 6, 30);
  // Parabolas would do as well; their ends meet at an angle that is known.
  const auto arc = [points](double bulge, int i) {
    const double x = -1.0 + 2.0 * i / points;
    return Point{x, bulge * (1.0 - x * x)};
  };
  Loop loop;
  for (int i = 0; i < points; ++i) loop.push_back(arc(low, i));
  for (int i = points; i > 0; --i) loop.push_back(arc(high, i));
  return loop;
}

/// A band around most of a circle, with a gap that may be narrow.
Loop openRing(Random& random) {
  const double gap = pickLogarithmic(random, 0.01, 2.0);
  const double inner = random.uniform(0.3, 0.95);
  const int points = pick(random, 16, 48);
  Loop loop;
  for (int i = 0; i <= points; ++i) loop.push_back(onCircle(1.0, gap + (2.0 * math::kPi - gap) * i / points));
  for (int i = points; i >= 0; --i) loop.push_back(onCircle(inner, gap + (2.0 * math::kPi - gap) * i / points));
  return loop;
}

double distanceToSegment(const Point& p, const Point& a, const Point& b) {
  const double ux = b.x - a.x;
  const double uy = b.y - a.y;
  const double length = ux * ux + uy * uy;
  const double t = length > 0.0 ? std::clamp(((p.x - a.x) * ux + (p.y - a.y) * uy) / length, 0.0, 1.0) : 0.0;
  const double dx = p.x - a.x - t * ux;
  const double dy = p.y - a.y - t * uy;
  return std::sqrt(dx * dx + dy * dy);
}

bool isInside(const Loop& loop, const Point& p) {
  bool inside = false;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
    if ((loop[i].y > p.y) == (loop[j].y > p.y)) continue;
    const double x = loop[i].x + (p.y - loop[i].y) * (loop[j].x - loop[i].x) / (loop[j].y - loop[i].y);
    if (p.x < x) inside = !inside;
  }
  return inside;
}

/// How far a point inside is from all loops; 0 for one that is not inside.
double clearance(const Polygon& polygon, const Point& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t l = 0; l < polygon.loops.size(); ++l) {
    const Loop& loop = polygon.loops[l];
    if (isInside(loop, p) != (l == 0)) return 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      least = std::min(least, distanceToSegment(p, loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  return least;
}

/// Circles, regular polygons and small stars where there is room; some all but touch what is around them.
void cutHoles(Polygon& polygon, Random& random) {
  const int wanted = pick(random, 0, 1) * pick(random, 1, 4);
  for (int attempt = 0; attempt < 20 && static_cast<int>(polygon.loops.size()) <= wanted; ++attempt) {
    const Point centre{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    const double room = clearance(polygon, centre);
    const double radius = room * random.uniform(0.2, 0.97);
    const bool isRound = pick(random, 0, 1) == 1;
    const int corners = isRound ? pick(random, 10, 28) : pick(random, 3, 6);
    const double start = random.uniform(0.0, 2.0 * math::kPi);
    const double dent = isRound ? 1.0 : random.uniform(0.5, 1.0);
    if (radius < 0.02) continue;
    Loop hole;
    for (int i = 0; i < corners; ++i) {
      const Point p = onCircle(i % 2 == 1 ? radius * dent : radius, start - 2.0 * math::kPi * i / corners);
      hole.push_back({centre.x + p.x, centre.y + p.y});
    }
    polygon.loops.push_back(std::move(hole));
  }
}

/// A loop under triangulation: points by number.
class EarClipper {
 public:
  explicit EarClipper(const Polygon& polygon) {
    std::vector<std::vector<std::int32_t>> holes;
    for (const Loop& loop : polygon.loops) {
      std::vector<std::int32_t> numbers;
      for (const Point& p : loop) {
        numbers.push_back(static_cast<std::int32_t>(points_.size()));
        points_.push_back(p);
      }
      if (left_.empty()) {
        left_ = std::move(numbers);
      } else {
        holes.push_back(std::move(numbers));
      }
    }
    // From the right to the left, so that a bridge never crosses a hole that is still to come.
    for (auto& hole : holes) {
      std::rotate(hole.begin(),
                  std::max_element(hole.begin(), hole.end(), [this](auto a, auto b) { return at(a).x < at(b).x; }),
                  hole.end());
    }
    std::sort(holes.begin(), holes.end(), [this](const auto& a, const auto& b) { return at(a[0]).x > at(b[0]).x; });
    for (const auto& hole : holes) bridge(hole);
  }

  std::vector<std::array<std::int32_t, 3>> run() {
    std::vector<std::array<std::int32_t, 3>> triangles;
    while (left_.size() > 2) {
      std::size_t best = left_.size();
      double bestShape = 0.0;
      for (std::size_t i = 0; i < left_.size(); ++i) {
        const double shape = shapeOf(i);
        if (shape > bestShape && isEar(i)) {
          best = i;
          bestShape = shape;
        }
      }
      if (best == left_.size()) return {};
      triangles.push_back({before(best), left_[best], after(best)});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(best));
    }
    return triangles;
  }

 private:
  [[nodiscard]] const Point& at(std::int32_t v) const { return points_[static_cast<std::size_t>(v)]; }
  [[nodiscard]] std::int32_t before(std::size_t i) const { return left_[(i + left_.size() - 1) % left_.size()]; }
  [[nodiscard]] std::int32_t after(std::size_t i) const { return left_[(i + 1) % left_.size()]; }

  /// Area over the square of the longest side.
  [[nodiscard]] double shapeOf(std::size_t i) const {
    const Point& a = at(before(i));
    const Point& b = at(left_[i]);
    const Point& c = at(after(i));
    const auto squared = [](const Point& p, const Point& q) {
      return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
    };
    const double longest = std::max({squared(a, b), squared(b, c), squared(c, a)});
    const double shape = longest > 0.0 ? turn(a, b, c) / longest : 0.0;
    return shape > 1e-9 ? shape : 0.0;
  }

  [[nodiscard]] bool isEar(std::size_t i) const {
    const std::array<std::int32_t, 3> ear{before(i), left_[i], after(i)};
    for (const std::int32_t v : left_) {
      if (std::find(ear.begin(), ear.end(), v) != ear.end()) continue;
      if (turn(at(ear[0]), at(ear[1]), at(v)) >= 0.0 && turn(at(ear[1]), at(ear[2]), at(v)) >= 0.0 &&
          turn(at(ear[2]), at(ear[0]), at(v)) >= 0.0) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] bool crosses(const Point& a, const Point& b) const {
    for (std::size_t i = 0; i < left_.size(); ++i) {
      const Point& c = at(left_[i]);
      const Point& d = at(after(i));
      const bool apart = turn(a, b, c) * turn(a, b, d) >= 0.0 || turn(c, d, a) * turn(c, d, b) >= 0.0;
      if (!apart) return true;
    }
    return false;
  }

  /// Joins a hole, which starts with its rightmost point, to the nearest corner to the right that sees it.
  void bridge(const std::vector<std::int32_t>& hole) {
    const Point& from = at(hole[0]);
    std::size_t best = left_.size();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < left_.size(); ++i) {
      const Point& to = at(left_[i]);
      const double length = (to.x - from.x) * (to.x - from.x) + (to.y - from.y) * (to.y - from.y);
      if (to.x < from.x || length >= nearest || !opensTowards(i, from) || crosses(from, to)) continue;
      best = i;
      nearest = length;
    }
    if (best == left_.size()) {
      left_.clear();
      return;
    }
    std::vector<std::int32_t> way(hole);
    way.push_back(hole[0]);
    way.push_back(left_[best]);
    left_.insert(left_.begin() + static_cast<std::ptrdiff_t>(best) + 1, way.begin(), way.end());
  }

  /// Whether a point lies within the corner's angle.
  [[nodiscard]] bool opensTowards(std::size_t i, const Point& p) const {
    const Point& a = at(before(i));
    const Point& b = at(left_[i]);
    const Point& c = at(after(i));
    const bool leftOfFirst = turn(a, b, p) > 0.0;
    const bool leftOfSecond = turn(b, c, p) > 0.0;
    return turn(a, b, c) > 0.0 ? leftOfFirst && leftOfSecond : leftOfFirst || leftOfSecond;
  }

  std::vector<Point> points_;
  std::vector<std::int32_t> left_;
};

double areaOf(const Loop& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point& a = loop[i];
    const Point& b = loop[(i + 1) % loop.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return 0.5 * twice;
}

}  // namespace

int pick(Random& random, int low, int high) {
  return low + static_cast<int>(random.next() % static_cast<std::uint64_t>(high - low + 1));
}

double pickLogarithmic(Random& random, double low, double high) {
  return math::exp(random.uniform(math::log(low), math::log(high)));
}

Polygon randomPolygon(Random& random) {
  using Maker = Loop (*)(Random&);
  constexpr std::array<Maker, 5> kMakers{star, blob, comb, crescent, openRing};
  Polygon polygon;
  polygon.loops.push_back(kMakers[static_cast<std::size_t>(pick(random, 0, 4))](random));
  cutHoles(polygon, random);
  return polygon;
}

std::vector<std::array<std::int32_t, 3>> triangulate(const Polygon& polygon) {
  const auto triangles = EarClipper(polygon).run();
  Loop points;
  double wanted = 0.0;
  for (const Loop& loop : polygon.loops) {
    wanted += areaOf(loop);
    points.insert(points.end(), loop.begin(), loop.end());
  }
  double area = 0.0;
  for (const auto& t : triangles) {
    area += 0.5 * turn(points[static_cast<std::size_t>(t[0])], points[static_cast<std::size_t>(t[1])],
                       points[static_cast<std::size_t>(t[2])]);
  }
  if (!(wanted > 0.0) || std::fabs(area - wanted) > 1e-9 * wanted) return {};
  return triangles;
}

}  // namespace qmcf::property
