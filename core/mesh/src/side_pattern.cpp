// Regular and one-singularity patterns of polygonal regions, as in the cavity remeshing of Verma and Suresh 2017.
#include "qmcf/mesh/side_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// A rectangle of vertex ids, width + 1 by height + 1, in the making.
class Grid {
 public:
  Grid(int width, int height) : width_(width), height_(height), ids_(index(width + 1) * index(height + 1), -1) {}
  int& at(int u, int v) { return ids_[index(v) * index(width_ + 1) + index(u)]; }

  /// Puts new vertices inside the border and makes the cells.
  void complete(SidePattern& pattern, const std::vector<Vec3>& loop) {
    const auto position = [&](int id) {
      return id < static_cast<int>(loop.size()) ? loop[index(id)] : pattern.inner[index(id) - loop.size()];
    };
    for (int v = 1; v < height_; ++v) {
      for (int u = 1; u < width_; ++u) {
        const double x = static_cast<double>(u) / width_;
        const double y = static_cast<double>(v) / height_;
        const Vec3 across = position(at(0, v)) * (1.0 - x) + position(at(width_, v)) * x;
        const Vec3 along = position(at(u, 0)) * (1.0 - y) + position(at(u, height_)) * y;
        const Vec3 bottom = position(at(0, 0)) * (1.0 - x) + position(at(width_, 0)) * x;
        const Vec3 top = position(at(0, height_)) * (1.0 - x) + position(at(width_, height_)) * x;
        at(u, v) = static_cast<int>(loop.size() + pattern.inner.size());
        pattern.inner.push_back(across + along - (bottom * (1.0 - y) + top * y));
      }
    }
    for (int v = 0; v < height_; ++v) {
      for (int u = 0; u < width_; ++u)
        pattern.cells.push_back({at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)});
    }
  }

 private:
  int width_;
  int height_;
  std::vector<int> ids_;
};

SidePattern gridPattern(const std::vector<Vec3>& loop, const std::vector<int>& corners, int width, int height) {
  const auto count = static_cast<int>(loop.size());
  SidePattern pattern;
  Grid grid(width, height);
  for (int u = 0; u <= width; ++u) {
    grid.at(u, 0) = (corners[0] + u) % count;
    grid.at(width - u, height) = (corners[2] + u) % count;
  }
  for (int v = 0; v <= height; ++v) {
    grid.at(width, v) = (corners[1] + v) % count;
    grid.at(0, height - v) = (corners[3] + v) % count;
  }
  grid.complete(pattern, loop);
  return pattern;
}

/// Numbers of edges of the sides of a loop or of its spokes, or the loop's corners: six at most.
class FewInts {
 public:
  FewInts() = default;
  explicit FewInts(std::size_t size) : size_(size) {}
  void push_back(int value) { values_[size_++] = value; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] int back() const { return values_[size_ - 1]; }
  int& operator[](std::size_t i) { return values_[i]; }
  int operator[](std::size_t i) const { return values_[i]; }

 private:
  std::array<int, 6> values_{};
  std::size_t size_ = 0;
};

/// Twice the length of spoke i. Side j is as long as spokes j - 1 and j + 1 together; going round in steps of two, all
/// other spokes cancel.
int twiceSpoke(const FewInts& sides, std::size_t i) {
  const std::size_t k = sides.size();
  int sum = 0;
  int sign = 1;
  std::size_t side = i + 1 < k ? i + 1 : 0;
  for (std::size_t step = 0; step < k; ++step) {
    sum += sign * sides[side];
    sign = -sign;
    side = side + 2 < k ? side + 2 : side + 2 - k;
  }
  return sum;
}

/// The least that twiceSpoke() may be; lastMayVanish: the middle may lie on the last side.
int leastTwiceSpoke(const FewInts& sides, std::size_t i, bool lastMayVanish) {
  return lastMayVanish && i + 1 == sides.size() ? 0 : 2;
}

/// Spokes run from a split of each side to the middle; spoke i is as long as the end of side i - 1 and the start of
/// side i + 1, so that the grids at the corners fit. Their lengths, or nothing if one is not a whole number above 0.
std::optional<FewInts> spokeLengths(const FewInts& sides, bool lastMayVanish = false) {
  FewInts spokes(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const int sum = twiceSpoke(sides, i);
    if (sum < leastTwiceSpoke(sides, i, lastMayVanish) || sum % 2 != 0) return std::nullopt;
    spokes[i] = sum / 2;
  }
  return spokes;
}

SidePattern spokePattern(const std::vector<Vec3>& loop, const FewInts& corners, const FewInts& spokes) {
  const auto count = static_cast<int>(loop.size());
  const std::size_t k = corners.size();
  const auto before = [k](std::size_t i) { return (i + k - 1) % k; };
  SidePattern pattern;
  Vec3 middle;
  int centre = count;
  if (spokes.back() > 0) {
    for (const Vec3& p : loop) middle += p / static_cast<double>(count);
    pattern.inner.push_back(middle);
  } else {
    centre = (corners.back() + spokes[before(k - 1)]) % count;
    middle = loop[index(centre)];
  }
  // Per spoke its vertices from the side to the middle.
  std::vector<std::vector<int>> spoke(k);
  for (std::size_t i = 0; i < k; ++i) {
    const int split = (corners[i] + spokes[before(i)]) % count;
    spoke[i].push_back(split);
    if (spokes[i] == 0) continue;
    // Where the middle lies on the last side, the spokes beside it run along that.
    const bool alongSide = spokes.back() == 0 && (i == 0 || i + 2 == k);
    for (int s = 1; s < spokes[i]; ++s) {
      if (alongSide) {
        spoke[i].push_back((split + (i == 0 ? count - s : s)) % count);
        continue;
      }
      const double t = static_cast<double>(s) / spokes[i];
      spoke[i].push_back(static_cast<int>(loop.size() + pattern.inner.size()));
      pattern.inner.push_back(loop[index(split)] * (1.0 - t) + middle * t);
    }
    spoke[i].push_back(centre);
  }
  for (std::size_t i = 0; i < k; ++i) {
    // Along side i from its corner to the split, and back along side i - 1 to its split.
    const int width = spokes[before(i)];
    const int height = spokes[i];
    if (width == 0 || height == 0) continue;
    Grid grid(width, height);
    for (int u = 0; u <= width; ++u) {
      grid.at(u, 0) = (corners[i] + u) % count;
      grid.at(u, height) = spoke[before(i)][index(u)];
    }
    for (int v = 0; v <= height; ++v) {
      grid.at(0, v) = (corners[i] - v + count) % count;
      grid.at(width, v) = spoke[i][index(v)];
    }
    grid.complete(pattern, loop);
  }
  return pattern;
}

FewInts fewOf(const std::vector<int>& values) {
  FewInts few;
  for (const int value : values) few.push_back(value);
  return few;
}

FewInts sideLengths(int count, const FewInts& corners) {
  FewInts sides;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sides.push_back((i + 1 < corners.size() ? corners[i + 1] : corners[0] + count) - corners[i]);
  }
  return sides;
}

/// A loop with sums over its vertices, and the length that its edges have on average.
struct Outline {
  explicit Outline(const std::vector<Vec3>& positions) : loop(positions), sum(1) {
    for (std::size_t i = 0; i < 2 * loop.size(); ++i) sum.push_back(sum.back() + loop[i % loop.size()]);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      edge += distance(loop[i], loop[(i + 1) % loop.size()]) / static_cast<double>(loop.size());
    }
  }
  [[nodiscard]] int count() const { return static_cast<int>(loop.size()); }

  const std::vector<Vec3>& loop;
  std::vector<Vec3> sum;  ///< Of the vertices before the i-th, for two rounds.
  double edge = 0.0;
};

/// One part of a loop that is cut in two: from a vertex along the loop to another, and back along the cut. The number
/// of the cut's edges may be changed.
class Part {
 public:
  Part(const Outline& outline, const std::vector<int>& corners, int from, int to)
      : outline_(outline), begin_(from), steps_((to - from + outline.count()) % outline.count()) {
    corners_.push_back(0);
    // The loop's corners that lie between, in the order of the part.
    const auto first = std::upper_bound(corners.begin(), corners.end(), begin_) - corners.begin();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int corner = corners[(index(static_cast<int>(first)) + i) % corners.size()];
      const int offset = (corner - begin_ + outline.count()) % outline.count();
      if (offset > 0 && offset < steps_) corners_.push_back(offset);
    }
    corners_.push_back(steps_);
  }
  void setCut(int edges) { cut_ = edges; }

  [[nodiscard]] int count() const { return steps_ + cut_; }
  [[nodiscard]] const FewInts& corners() const { return corners_; }
  /// The last side is the cut.
  [[nodiscard]] FewInts sides() const { return sideLengths(count(), corners_); }
  /// A vertex of the part's loop: of the whole loop, or past these the inner ones of the cut, counted from its begin.
  [[nodiscard]] int id(int offset, bool other) const {
    if (offset <= steps_) return (begin_ + offset) % outline_.count();
    const int fromEnd = offset - steps_;
    return outline_.count() + (other ? fromEnd : cut_ - fromEnd) - 1;
  }
  [[nodiscard]] Vec3 position(int offset) const {
    if (offset <= steps_) return outline_.loop[index((begin_ + offset) % outline_.count())];
    const double t = static_cast<double>(offset - steps_) / cut_;
    return position(steps_) * (1.0 - t) + position(0) * t;
  }
  [[nodiscard]] Vec3 middle() const {
    const Vec3 along = outline_.sum[index(begin_ + steps_ + 1)] - outline_.sum[index(begin_)];
    return (along + (position(0) + position(steps_)) * (0.5 * (cut_ - 1))) / count();
  }

 private:
  const Outline& outline_;
  int begin_;
  int steps_;
  int cut_ = 0;
  FewInts corners_;
};

/// Numbers of edges from the least to the most.
struct Range {
  int least = 0;
  int most = 0;
};

/// Narrows the numbers of a cut's edges to those with which no spoke of the part is too short.
void narrow(Range& range, Part& part) {
  part.setCut(0);
  const FewInts sides = part.sides();
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const int room = twiceSpoke(sides, i) - leastTwiceSpoke(sides, i, true);
    // Whether the last side is reached from side i + 1 by an even number of steps of two: then it counts for the spoke.
    const std::size_t ahead = sides.size() - 1 - (i + 1) % sides.size();
    if ((ahead % 2 == 0 ? ahead / 2 : (ahead + sides.size()) / 2) % 2 == 0) {
      range.least = std::max(range.least, -room);
    } else {
      range.most = std::min(range.most, room);
    }
  }
}

/// How far a line of so many edges is from edges of the length h: the square of the ratio's logarithm.
double misfit(double length, int edges, double h) {
  const double ratio = math::log(std::max(length, 1e-3 * h) / (edges * h));
  return ratio * ratio;
}

/// How a part is filled around one vertex.
struct Filling {
  double misfit = 0.0;   ///< The sum over the spokes.
  int centreOnCut = -1;  ///< How far along the part's cut the vertex lies; -1 if it lies inside.
  int cells = 0;
};

/// Nothing if the misfit is at least `most`. \pre the cut is as long as narrow() asks, the part's loop even
std::optional<Filling> fillingOf(const Part& part, double h, double most) {
  const FewInts spokes = *spokeLengths(part.sides(), true);
  const std::size_t k = spokes.size();
  Filling filling;
  Vec3 middle = part.middle();
  if (spokes.back() == 0) {
    filling.centreOnCut = spokes[k - 2];
    middle = part.position(part.corners().back() + filling.centreOnCut);
  }
  for (std::size_t i = 0; i < k; ++i) {
    const int before = i > 0 ? spokes[i - 1] : spokes.back();
    const int past = part.corners()[i] + before;
    const int split = past < part.count() ? past : past - part.count();
    filling.cells += before * spokes[i];
    if (spokes[i] > 0) filling.misfit += misfit(distance(part.position(split), middle), spokes[i], h);
    if (filling.misfit >= most) return std::nullopt;
  }
  return filling;
}

/// The best of the cuts seen so far, the best first; among equals those seen first.
class BestCuts {
 public:
  explicit BestCuts(std::size_t most) : most_(most) {}
  /// Cuts with this misfit or more are of no use.
  [[nodiscard]] double limit() const {
    return cuts_.size() < most_ ? std::numeric_limits<double>::infinity() : cuts_.back().first;
  }
  void add(double misfit, const SideCut& cut) {
    if (!(misfit < limit())) return;
    const auto place = std::upper_bound(cuts_.begin(), cuts_.end(), misfit,
                                        [](double value, const auto& entry) { return value < entry.first; });
    cuts_.insert(place, {misfit, cut});
    if (cuts_.size() > most_) cuts_.pop_back();
  }
  [[nodiscard]] std::vector<SideCut> take() const {
    std::vector<SideCut> cuts;
    cuts.reserve(cuts_.size());
    for (const auto& [misfit, cut] : cuts_) cuts.push_back(cut);
    return cuts;
  }

 private:
  std::size_t most_;
  std::vector<std::pair<double, SideCut>> cuts_;
};

/// Adds the cuts between two vertices of a loop.
void addCuts(const Outline& outline, const std::vector<int>& corners, int from, int to, BestCuts& best) {
  constexpr double kLeast = 0.6;  // Edges of a cut, in units of those that would have the loop's mean length.
  constexpr double kMost = 1.5;
  const double h = outline.edge;
  const double length = distance(outline.loop[index(from)], outline.loop[index(to)]);
  Range range{std::max(1, static_cast<int>(kLeast * length / h)), static_cast<int>(std::ceil(kMost * length / h))};
  Part first(outline, corners, from, to);
  Part second(outline, corners, to, from);
  narrow(range, first);
  narrow(range, second);
  // Both parts need loops of even length.
  if ((first.count() + range.least) % 2 != 0) ++range.least;
  for (int edges = range.least; edges <= range.most; edges += 2) {
    // No term of the sum is negative.
    const double own = misfit(length, edges, h);
    const double limit = best.limit();
    if (own >= limit) continue;
    first.setCut(edges);
    const auto firstFilling = fillingOf(first, h, limit);
    if (!firstFilling) continue;
    second.setCut(edges);
    const auto secondFilling = fillingOf(second, h, limit);
    if (!secondFilling) continue;
    // The parts run along the cut in opposite directions. Both middles in one place are one vertex.
    const bool onCut = firstFilling->centreOnCut >= 0 && secondFilling->centreOnCut >= 0;
    if (onCut && firstFilling->centreOnCut + secondFilling->centreOnCut == edges) continue;
    const int cells = firstFilling->cells + secondFilling->cells;
    best.add(firstFilling->misfit + secondFilling->misfit + own, {from, to, edges, cells});
  }
}

}  // namespace

std::optional<SidePattern> fillSides(const std::vector<Vec3>& loop, const std::vector<int>& corners) {
  const std::size_t k = corners.size();
  if (k < 3 || k > 5) return std::nullopt;
  const FewInts starts = fewOf(corners);
  const FewInts sides = sideLengths(static_cast<int>(loop.size()), starts);
  if (k == 4) {
    if (sides[0] != sides[2] || sides[1] != sides[3]) return std::nullopt;
    return gridPattern(loop, corners, sides[0], sides[1]);
  }
  const auto spokes = spokeLengths(sides);
  if (!spokes) return std::nullopt;
  return spokePattern(loop, starts, *spokes);
}

std::vector<SideCut> cutsInTwo(const std::vector<Vec3>& loop, const std::vector<int>& corners, std::size_t most) {
  const std::size_t k = corners.size();
  if ((k != 2 && k != 4 && k != 6) || loop.size() % 2 != 0) return {};
  const auto count = static_cast<int>(loop.size());
  const FewInts sides = sideLengths(count, fewOf(corners));
  const Outline outline(loop);
  if (!(outline.edge > 0.0)) return {};
  // The first part has one corner of two or four, three of six; of the others each cut would be met from both sides.
  const std::size_t apart = k == 6 ? 3 : 1;
  const std::size_t starts = k == 4 ? 4 : k / 2;
  BestCuts best(most);
  for (std::size_t s = 0; s < starts; ++s) {
    const std::size_t t = (s + apart) % k;
    for (int a = 1; a < sides[s]; ++a) {
      for (int b = 1; b < sides[t]; ++b) {
        addCuts(outline, corners, (corners[s] + a) % count, (corners[t] + b) % count, best);
      }
    }
  }
  return best.take();
}

SidePattern fillCut(const std::vector<Vec3>& loop, const std::vector<int>& corners, const SideCut& cut) {
  const Outline outline(loop);
  std::array<Part, 2> parts{Part(outline, corners, cut.from, cut.to), Part(outline, corners, cut.to, cut.from)};
  for (Part& part : parts) part.setCut(cut.length);
  SidePattern joined;
  for (int s = 1; s < cut.length; ++s) joined.inner.push_back(parts[0].position(parts[0].count() - s));
  for (const bool other : {false, true}) {
    const Part& part = parts[other ? 1 : 0];
    std::vector<Vec3> own;
    for (int i = 0; i < part.count(); ++i) own.push_back(part.position(i));
    const SidePattern filled = spokePattern(own, part.corners(), *spokeLengths(part.sides(), true));
    const int firstInner = outline.count() + static_cast<int>(joined.inner.size());
    for (std::array<int, 4> cell : filled.cells) {
      for (int& id : cell) id = id < part.count() ? part.id(id, other) : firstInner + id - part.count();
      joined.cells.push_back(cell);
    }
    joined.inner.insert(joined.inner.end(), filled.inner.begin(), filled.inner.end());
  }
  return joined;
}

}  // namespace qmcf
