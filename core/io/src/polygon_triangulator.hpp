#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "qmcf/base/vec.hpp"

namespace qmcf {

/// Cuts polygons in space into triangles without new vertices: n corners give n - 2 triangles, oriented like the
/// polygon. A quadrilateral is cut along the only diagonal inside it; of two, a flat one along the shorter,
/// a bent one from its first corner. Larger polygons lose ears in the plane they lie in, well-shaped ones first;
/// whatever defies that (self-intersecting outlines) ends as a fan. Typically O(n log n) for n corners; the number of
/// steps is bounded by a multiple of n whatever the outline.
class PolygonTriangulator {
 public:
  explicit PolygonTriangulator(const std::vector<Vec3>& positions) : positions_(positions) {}

  /// Appends the triangles of one polygon. \pre polygon.size() >= 3, all indices in range.
  void triangulate(std::span<const std::int32_t> polygon, std::vector<std::array<std::int32_t, 3>>& triangles);

 private:
  enum class EarTest : std::uint8_t { ear, notEar, outOfBudget };

  void cutQuad(std::span<const std::int32_t> quad, std::vector<std::array<std::int32_t, 3>>& triangles) const;
  bool project(std::span<const std::int32_t> polygon);
  void linkCorners(std::size_t count);
  void buildGrid();
  [[nodiscard]] bool isBlocking(std::size_t corner) const;
  [[nodiscard]] std::size_t cellOf(double coordinate) const;
  EarTest testEar(std::size_t tip, std::size_t level);
  [[nodiscard]] bool blocks(std::size_t corner, const std::array<std::size_t, 3>& ear, double tolerance) const;
  /// Cuts off ears until three corners are left or none can be cut; returns a corner that is left.
  std::size_t clipEars(std::span<const std::int32_t> polygon, std::vector<std::array<std::int32_t, 3>>& triangles);
  void fan(std::span<const std::int32_t> polygon, std::size_t first,
           std::vector<std::array<std::int32_t, 3>>& triangles) const;

  const std::vector<Vec3>& positions_;
  std::vector<Vec2> points_;  ///< Corners in the plane, in the unit square, counter-clockwise.
  std::vector<std::size_t> next_;
  std::vector<std::size_t> previous_;
  std::vector<std::uint8_t> blocking_;  ///< Reflex or straight corners that are left: only these can lie in an ear.
  std::vector<std::size_t> cellStart_;  ///< Grid over the blocking corners, row by row.
  std::vector<std::size_t> cellCorners_;
  std::size_t cells_ = 1;   ///< Cells per side.
  std::size_t budget_ = 0;  ///< Steps left.
};

}  // namespace qmcf
