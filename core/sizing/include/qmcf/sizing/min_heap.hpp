#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace qmcf {

/// Ids by their keys, smallest key first, then smallest id. Entries are never removed: who pops checks for stale ones.
class MinHeap {
 public:
  using Entry = std::pair<double, std::int32_t>;

  void push(double key, std::int32_t id) { queue_.emplace(key, id); }
  [[nodiscard]] bool empty() const { return queue_.empty(); }
  Entry pop() {
    const Entry top = queue_.top();
    queue_.pop();
    return top;
  }

 private:
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace qmcf
