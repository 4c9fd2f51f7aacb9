// Regular and one-singularity patterns of polygonal regions, as in the cavity remeshing of Verma and Suresh 2017.
#include "qmcf/mesh/side_pattern.hpp"

#include <cstddef>

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

/// Spokes run from a split of each side to the middle; spoke i is as long as the end of side i - 1 and the start of
/// side i + 1, so that the grids at the corners fit. Their lengths, or nothing if one is not a whole number above 0.
std::optional<std::vector<int>> spokeLengths(const std::vector<int>& sides) {
  const std::size_t k = sides.size();
  std::vector<int> spokes(k);
  for (std::size_t i = 0; i < k; ++i) {
    // side j = spoke j-1 + spoke j+1; going round in steps of two, all other spokes cancel.
    int sum = 0;
    int sign = 1;
    for (std::size_t step = 0; step < k; ++step) {
      sum += sign * sides[(i + 1 + 2 * step) % k];
      sign = -sign;
    }
    if (sum < 2 || sum % 2 != 0) return std::nullopt;
    spokes[i] = sum / 2;
  }
  return spokes;
}

SidePattern spokePattern(const std::vector<Vec3>& loop, const std::vector<int>& corners,
                         const std::vector<int>& spokes) {
  const auto count = static_cast<int>(loop.size());
  const std::size_t k = corners.size();
  SidePattern pattern;
  Vec3 middle;
  for (const Vec3& p : loop) middle += p / static_cast<double>(count);
  const int centre = count;
  pattern.inner.push_back(middle);
  const auto before = [k](std::size_t i) { return (i + k - 1) % k; };
  // Per spoke its vertices from the side to the middle.
  std::vector<std::vector<int>> spoke(k);
  for (std::size_t i = 0; i < k; ++i) {
    const int split = (corners[i] + spokes[before(i)]) % count;
    spoke[i].push_back(split);
    for (int s = 1; s < spokes[i]; ++s) {
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

}  // namespace

std::optional<SidePattern> fillSides(const std::vector<Vec3>& loop, const std::vector<int>& corners) {
  const std::size_t k = corners.size();
  if (k < 3 || k > 5) return std::nullopt;
  const auto count = static_cast<int>(loop.size());
  std::vector<int> sides;
  for (std::size_t i = 0; i < k; ++i) {
    const int next = i + 1 < k ? corners[i + 1] : corners[0] + count;
    sides.push_back(next - corners[i]);
  }
  if (k == 4) {
    if (sides[0] != sides[2] || sides[1] != sides[3]) return std::nullopt;
    return gridPattern(loop, corners, sides[0], sides[1]);
  }
  const auto spokes = spokeLengths(sides);
  if (!spokes) return std::nullopt;
  return spokePattern(loop, corners, *spokes);
}

}  // namespace qmcf
