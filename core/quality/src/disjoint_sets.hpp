#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace qmcf::quality {

/// Disjoint sets over 0..n-1; the root is the smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  std::int32_t root(std::int32_t i) {
    while (parent_[index(i)] != i) {
      parent_[index(i)] = parent_[index(parent_[index(i)])];
      i = parent_[index(i)];
    }
    return i;
  }
  void join(std::int32_t i, std::int32_t j) {
    const std::int32_t a = root(i);
    const std::int32_t b = root(j);
    parent_[index(std::max(a, b))] = std::min(a, b);
  }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  std::vector<std::int32_t> parent_;
};

}  // namespace qmcf::quality
