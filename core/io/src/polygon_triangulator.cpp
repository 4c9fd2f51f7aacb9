#include "polygon_triangulator.hpp"

#include <algorithm>
#include <cmath>

namespace qmcf {
namespace {

/// How good a triangle must be to be cut off: twice the area over the longest side squared. Taking the good ones first
/// leaves fewer needles than taking any.
constexpr std::array<double, 4> kEarQuality{0.2, 0.02, 1e-5, 1e-12};
/// Cosine of the angle between the halves of a quadrilateral up to which it counts as flat.
constexpr double kFlat = 0.9999;
/// How far outside an ear a corner still blocks it, in units of the polygon's extent: coordinates in files are rounded.
constexpr std::array<double, 4> kTolerance{1e-9, 1e-9, 1e-12, 0.0};

double areaAlong(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  return dot(cross(b - a, c - a), normal);
}

double turn(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); }

}  // namespace

void PolygonTriangulator::triangulate(std::span<const std::int32_t> polygon,
                                      std::vector<std::array<std::int32_t, 3>>& triangles) {
  if (polygon.size() == 3) {
    triangles.push_back({polygon[0], polygon[1], polygon[2]});
  } else if (polygon.size() == 4) {
    cutQuad(polygon, triangles);
  } else if (!project(polygon)) {
    linkCorners(polygon.size());
    fan(polygon, 0, triangles);
  } else {
    linkCorners(polygon.size());
    buildGrid();
    fan(polygon, clipEars(polygon, triangles), triangles);
  }
}

void PolygonTriangulator::cutQuad(std::span<const std::int32_t> quad,
                                  std::vector<std::array<std::int32_t, 3>>& triangles) const {
  const auto point = [&](std::size_t i) { return positions_[static_cast<std::size_t>(quad[i])]; };
  const Vec3 a = point(0);
  const Vec3 b = point(1);
  const Vec3 c = point(2);
  const Vec3 d = point(3);
  const Vec3 normal = cross(c - a, d - b);
  const bool acInside = areaAlong(a, b, c, normal) > 0.0 && areaAlong(a, c, d, normal) > 0.0;
  const bool bdInside = areaAlong(b, c, d, normal) > 0.0 && areaAlong(b, d, a, normal) > 0.0;
  // The factor keeps rows of rectangles from being cut one way here and the other way there by rounding.
  const bool bdShorter = squaredNorm(d - b) < 0.999 * squaredNorm(c - a);
  // The diagonal decides what surface a bent quadrilateral is; other programs cut it from its first corner.
  const Vec3 first = cross(b - a, c - a);
  const Vec3 second = cross(c - a, d - a);
  const bool bent = dot(first, second) < kFlat * norm(first) * norm(second);
  if (acInside == bdInside ? bdShorter && !bent : bdInside) {
    triangles.push_back({quad[1], quad[2], quad[3]});
    triangles.push_back({quad[1], quad[3], quad[0]});
  } else {
    triangles.push_back({quad[0], quad[1], quad[2]});
    triangles.push_back({quad[0], quad[2], quad[3]});
  }
}

bool PolygonTriangulator::project(std::span<const std::int32_t> polygon) {
  const auto point = [&](std::size_t i) -> const Vec3& { return positions_[static_cast<std::size_t>(polygon[i])]; };
  Vec3 low = point(0);
  Vec3 high = low;
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    const Vec3& p = point(i);
    low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
    high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
  }
  const Vec3 size = high - low;
  const double extent = std::fmax(size.x, std::fmax(size.y, size.z));
  if (!(extent > 0.0) || !std::isfinite(extent)) return false;

  const auto unit = [&](std::size_t i) { return (point(i) - low) / extent; };
  Vec3 normal;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) normal += cross(unit(i) - unit(0), unit(i + 1) - unit(0));
  const Vec3 a{std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
  const double largest = std::fmax(a.x, std::fmax(a.y, a.z));
  if (!(largest > 0.0)) return false;

  // Leaving out one coordinate instead of turning the polygon keeps what is exactly straight exactly straight.
  points_.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 p = unit(i);
    Vec2 q = a.z == largest ? Vec2{p.x, p.y} : a.y == largest ? Vec2{p.z, p.x} : Vec2{p.y, p.z};
    const double sign = a.z == largest ? normal.z : a.y == largest ? normal.y : normal.x;
    if (sign < 0.0) q = {1.0 - q.x, q.y};
    points_.push_back(q);
  }
  return true;
}

void PolygonTriangulator::linkCorners(std::size_t count) {
  next_.resize(count);
  previous_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    next_[i] = i + 1 == count ? 0 : i + 1;
    previous_[i] = i == 0 ? count - 1 : i - 1;
  }
}

bool PolygonTriangulator::isBlocking(std::size_t corner) const {
  const Vec2 p = points_[corner];
  const Vec2 in = p - points_[previous_[corner]];
  const Vec2 out = points_[next_[corner]] - p;
  return cross(in, out) <= 1e-9 * norm(in) * norm(out);
}

std::size_t PolygonTriangulator::cellOf(double coordinate) const {
  const double cell = coordinate * static_cast<double>(cells_);
  if (!(cell > 0.0)) return 0;
  return std::min(static_cast<std::size_t>(cell), cells_ - 1);
}

void PolygonTriangulator::buildGrid() {
  const std::size_t count = points_.size();
  blocking_.resize(count);
  std::size_t blockingCount = 0;
  for (std::size_t i = 0; i < count; ++i) {
    blocking_[i] = isBlocking(i) ? 1 : 0;
    blockingCount += blocking_[i];
  }
  cells_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(blockingCount))), 1, 1024);
  cellStart_.assign(cells_ * cells_ + 1, 0);
  const auto cell = [&](std::size_t i) { return cellOf(points_[i].y) * cells_ + cellOf(points_[i].x); };
  for (std::size_t i = 0; i < count; ++i) {
    if (blocking_[i] != 0) ++cellStart_[cell(i) + 1];
  }
  for (std::size_t c = 0; c < cells_ * cells_; ++c) cellStart_[c + 1] += cellStart_[c];
  cellCorners_.resize(blockingCount);
  std::vector<std::size_t> fill(cellStart_.begin(), cellStart_.end() - 1);
  for (std::size_t i = 0; i < count; ++i) {
    if (blocking_[i] != 0) cellCorners_[fill[cell(i)]++] = i;
  }
  budget_ = 200 * count + 1'000'000;
}

bool PolygonTriangulator::blocks(std::size_t corner, const std::array<std::size_t, 3>& ear, double tolerance) const {
  if (blocking_[corner] == 0 || corner == ear[0] || corner == ear[1] || corner == ear[2]) return false;
  const Vec2 w = points_[corner];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 a = points_[ear[k]];
    const Vec2 b = points_[ear[(k + 1) % 3]];
    // Outlines with holes run along bridges twice: a corner at the same place as one of the ear's is no obstacle.
    if (w == a || turn(a, b, w) < -tolerance * norm(b - a)) return false;
  }
  return true;
}

PolygonTriangulator::EarTest PolygonTriangulator::testEar(std::size_t tip, std::size_t level) {
  const std::array<std::size_t, 3> ear{previous_[tip], tip, next_[tip]};
  const Vec2 a = points_[ear[0]];
  const Vec2 b = points_[ear[1]];
  const Vec2 c = points_[ear[2]];
  if (budget_ == 0) return EarTest::outOfBudget;
  --budget_;
  const double longest = std::fmax(dot(b - a, b - a), std::fmax(dot(c - b, c - b), dot(a - c, a - c)));
  if (!(turn(a, b, c) > kEarQuality[level] * longest)) return EarTest::notEar;

  const double reach = kTolerance[level];
  const std::size_t firstColumn = cellOf(std::fmin(a.x, std::fmin(b.x, c.x)) - reach);
  const std::size_t lastColumn = cellOf(std::fmax(a.x, std::fmax(b.x, c.x)) + reach);
  const std::size_t firstRow = cellOf(std::fmin(a.y, std::fmin(b.y, c.y)) - reach);
  const std::size_t lastRow = cellOf(std::fmax(a.y, std::fmax(b.y, c.y)) + reach);
  for (std::size_t row = firstRow; row <= lastRow; ++row) {
    const std::size_t begin = cellStart_[row * cells_ + firstColumn];
    const std::size_t end = cellStart_[row * cells_ + lastColumn + 1];
    for (std::size_t k = begin; k < end; ++k) {
      if (budget_ == 0) return EarTest::outOfBudget;
      --budget_;
      if (blocks(cellCorners_[k], ear, reach)) return EarTest::notEar;
    }
  }
  return EarTest::ear;
}

std::size_t PolygonTriangulator::clipEars(std::span<const std::int32_t> polygon,
                                          std::vector<std::array<std::int32_t, 3>>& triangles) {
  std::size_t left = polygon.size();
  std::size_t corner = 0;
  for (std::size_t level = 0; level < kEarQuality.size(); ++level) {
    std::size_t sinceLastEar = 0;
    while (left > 3 && sinceLastEar < left) {
      const EarTest test = testEar(corner, level);
      if (test == EarTest::outOfBudget) return corner;
      if (test == EarTest::notEar) {
        corner = next_[corner];
        ++sinceLastEar;
        continue;
      }
      const std::size_t before = previous_[corner];
      const std::size_t after = next_[corner];
      triangles.push_back({polygon[before], polygon[corner], polygon[after]});
      next_[before] = after;
      previous_[after] = before;
      blocking_[corner] = 0;
      for (const std::size_t neighbour : {before, after}) {
        if (blocking_[neighbour] != 0 && !isBlocking(neighbour)) blocking_[neighbour] = 0;
      }
      --left;
      sinceLastEar = 0;
      corner = next_[after];  // Going on behind the new edge spreads the cuts around the outline.
    }
  }
  return corner;
}

void PolygonTriangulator::fan(std::span<const std::int32_t> polygon, std::size_t first,
                              std::vector<std::array<std::int32_t, 3>>& triangles) const {
  for (std::size_t i = next_[first]; next_[i] != first; i = next_[i]) {
    triangles.push_back({polygon[first], polygon[i], polygon[next_[i]]});
  }
}

}  // namespace qmcf
