#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "qmcf/mesh/ids.hpp"

namespace qmcf {

/// The front edges still to be worked on, in the order in which they shall be: by level (rows of quads from where the
/// front began), then by state (both side edges there before one before none), then by age. Ties do not exist, so the
/// order is the same everywhere.
class FrontQueue {
 public:
  struct Item {
    std::int32_t level = 0;
    std::int32_t rank = 0;
    std::int64_t age = 0;
    HalfedgeId edge;
    std::int32_t stamp = 0;

    friend bool operator<(const Item& a, const Item& b) {
      return std::tie(a.level, a.rank, a.age, a.edge) > std::tie(b.level, b.rank, b.age, b.edge);
    }
  };

  /// Queues an edge, or queues it anew; an earlier entry of it becomes void.
  void push(HalfedgeId h, std::int32_t level, std::int32_t rank) {
    if (h.index() >= stamps_.size()) stamps_.resize(h.index() + 1, 0);
    heap_.push_back({level, rank, age_++, h, ++stamps_[h.index()]});
    std::push_heap(heap_.begin(), heap_.end());
  }
  /// The next edge, or an invalid id when there is none.
  HalfedgeId pop() {
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Item item = heap_.back();
      heap_.pop_back();
      if (stamps_[item.edge.index()] == item.stamp) return item.edge;
    }
    return {};
  }
  [[nodiscard]] std::size_t size() const { return heap_.size(); }

 private:
  std::vector<Item> heap_;
  std::vector<std::int32_t> stamps_;
  std::int64_t age_ = 0;
};

}  // namespace qmcf
