#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "qmcf/mesh/ids.hpp"

namespace qmcf {

/// The front edges in the order in which Q-Morph takes them: by state (1-1 before 0-1 and 1-0 before 0-0), then by
/// level, then the shortest (Owen et al. 1999). Ties go to the smaller id.
class StateQueue {
 public:
  /// Queues an edge, or queues it anew; an earlier entry of it becomes void.
  void push(HalfedgeId h, std::int32_t state, std::int32_t level, double length) {
    if (h.index() >= stamps_.size()) stamps_.resize(h.index() + 1, 0);
    heap_.push_back({state, level, length, h, ++stamps_[h.index()]});
    std::push_heap(heap_.begin(), heap_.end(), later);
  }
  /// The next edge, or an invalid id when there is none.
  HalfedgeId pop() {
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end(), later);
      const Item item = heap_.back();
      heap_.pop_back();
      if (stamps_[item.edge.index()] == item.stamp) return item.edge;
    }
    return {};
  }

 private:
  struct Item {
    std::int32_t state = 0;
    std::int32_t level = 0;
    double length = 0.0;
    HalfedgeId edge;
    std::int32_t stamp = 0;
  };
  static bool later(const Item& a, const Item& b) {
    return std::tie(a.state, a.level, a.length, a.edge) > std::tie(b.state, b.level, b.length, b.edge);
  }

  std::vector<Item> heap_;
  std::vector<std::int32_t> stamps_;
};

}  // namespace qmcf
