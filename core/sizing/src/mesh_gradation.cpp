#include "mesh_gradation.hpp"

#include <algorithm>

#include "qmcf/sizing/min_heap.hpp"

namespace qmcf {

MeshGradation::MeshGradation(const std::vector<Vec3>& positions,
                             const std::vector<std::array<std::int32_t, 3>>& triangles)
    : positions_(positions) {
  first_.assign(positions.size() + 1, 0);
  for (const auto& t : triangles) {
    for (const std::int32_t v : t) first_[static_cast<std::size_t>(v) + 1] += 2;
  }
  for (std::size_t v = 0; v < positions.size(); ++v) first_[v + 1] += first_[v];
  neighbor_.resize(first_.back());
  std::vector<std::size_t> next = first_;
  for (const auto& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto v = static_cast<std::size_t>(t[c]);
      neighbor_[next[v]++] = t[(c + 1) % 3];
      neighbor_[next[v]++] = t[(c + 2) % 3];
    }
  }
}

void MeshGradation::grade(std::vector<double>& value, double highest, double slope) const {
  MinHeap heap;
  for (std::size_t v = 0; v < value.size(); ++v) {
    if (!(value[v] < highest)) continue;
    // Most of them lower nothing around them, unless they get lower themselves.
    const auto lowers = [&](std::int32_t neighbor) {
      const auto w = static_cast<std::size_t>(neighbor);
      return value[v] + slope * distance(positions_[v], positions_[w]) < value[w];
    };
    const auto begin = neighbor_.begin() + static_cast<std::ptrdiff_t>(first_[v]);
    const auto end = neighbor_.begin() + static_cast<std::ptrdiff_t>(first_[v + 1]);
    if (std::any_of(begin, end, lowers)) heap.push(value[v], static_cast<std::int32_t>(v));
  }
  while (!heap.empty()) {
    const auto [size, vertex] = heap.pop();
    const auto v = static_cast<std::size_t>(vertex);
    if (size > value[v]) continue;
    for (std::size_t i = first_[v]; i < first_[v + 1]; ++i) {
      const auto w = static_cast<std::size_t>(neighbor_[i]);
      const double graded = size + slope * distance(positions_[v], positions_[w]);
      if (!(graded < value[w])) continue;
      value[w] = graded;
      heap.push(graded, neighbor_[i]);
    }
  }
}

}  // namespace qmcf
