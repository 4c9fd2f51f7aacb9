#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "qmcf/base/vec.hpp"

namespace qmcf {

/// Limits the slope of values at the vertices of a triangle mesh along its edges, by Dijkstra's algorithm.
class MeshGradation {
 public:
  /// Keeps a reference to the positions.
  MeshGradation(const std::vector<Vec3>& positions, const std::vector<std::array<std::int32_t, 3>>& triangles);

  /// Lowers values to the least of value + slope * length over all ways from other vertices. Vertices that are not
  /// below `highest` are no beginning of a way.
  void grade(std::vector<double>& value, double highest, double slope) const;

 private:
  const std::vector<Vec3>& positions_;
  std::vector<std::size_t> first_;  ///< Per vertex: its first neighbour; then the end.
  std::vector<std::int32_t> neighbor_;
};

}  // namespace qmcf
