#include "parity.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace qmcf {
namespace {

/// Disjoint sets.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  /// False when both were in one set already.
  bool join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return false;
    parent_[std::max(a, b)] = std::min(a, b);
    return true;
  }

 private:
  std::vector<std::size_t> parent_;
};

/// A set of ids over GF(2): ascending, each once.
using Combination = std::vector<std::int32_t>;

Combination sumOf(const Combination& a, const Combination& b) {
  Combination sum;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(sum));
  return sum;
}

/// Changes as edges between faces; the node after the last face stands for "no face".
class ParityGraph {
 public:
  ParityGraph(std::vector<bool> odd, const std::vector<ParityChange>& changes)
      : changes_(changes),
        odd_(std::move(odd)),
        ground_(odd_.size()),
        apply_(changes.size(), false),
        sets_(ground_ + 1) {
    order_.resize(changes.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return changes[a].cost != changes[b].cost ? changes[a].cost < changes[b].cost : a < b;
    });
  }

  ParitySolution solve() {
    growForest();
    useWideChanges();
    rootForest();
    improve();
    return {std::move(apply_), oddFaces_};
  }

 private:
  [[nodiscard]] bool isEdge(std::size_t change) const {
    return changes_[change].faces.size() == 1 || changes_[change].faces.size() == 2;
  }
  [[nodiscard]] std::size_t firstEnd(std::size_t change) const {
    return static_cast<std::size_t>(changes_[change].faces.front());
  }
  [[nodiscard]] std::size_t secondEnd(std::size_t change) const {
    return changes_[change].faces.size() == 2 ? static_cast<std::size_t>(changes_[change].faces.back()) : ground_;
  }

  void growForest() {
    tree_.resize(ground_ + 1);
    for (const std::size_t change : order_) {
      if (!isEdge(change)) continue;
      if (!sets_.join(firstEnd(change), secondEnd(change))) {
        rest_.push_back(change);
        continue;
      }
      tree_[firstEnd(change)].push_back({secondEnd(change), change});
      tree_[secondEnd(change)].push_back({firstEnd(change), change});
    }
  }

  /// The components without a way to "no face" whose parity a change of these faces changes.
  Combination componentsOf(const std::vector<std::int32_t>& faces) {
    Combination components;
    for (const std::int32_t face : faces) {
      const std::size_t component = sets_.find(static_cast<std::size_t>(face));
      if (component != sets_.find(ground_)) components = sumOf(components, {static_cast<std::int32_t>(component)});
    }
    return components;
  }

  /// Gaussian elimination with the cheapest columns first.
  void useWideChanges() {
    struct Row {
      Combination components;
      Combination changes;
    };
    std::vector<Row> rows;
    std::vector<std::int32_t> rowOfPivot(ground_ + 1, -1);
    const auto reduce = [&](Row& row) {
      while (!row.components.empty()) {
        const std::int32_t pivot = rowOfPivot[static_cast<std::size_t>(row.components.back())];
        if (pivot < 0) return;
        row.changes = sumOf(row.changes, rows[static_cast<std::size_t>(pivot)].changes);
        row.components = sumOf(row.components, rows[static_cast<std::size_t>(pivot)].components);
      }
    };
    for (const std::size_t change : order_) {
      if (changes_[change].faces.size() < 3) continue;
      Row row{componentsOf(changes_[change].faces), {static_cast<std::int32_t>(change)}};
      reduce(row);
      if (row.components.empty()) continue;
      rowOfPivot[static_cast<std::size_t>(row.components.back())] = static_cast<std::int32_t>(rows.size());
      rows.push_back(std::move(row));
    }
    std::vector<std::int32_t> oddFaces;
    for (std::size_t f = 0; f < ground_; ++f) {
      if (odd_[f]) oddFaces.push_back(static_cast<std::int32_t>(f));
    }
    Row target{componentsOf(oddFaces), {}};
    // Component by component, so that one without a solution does not keep the others from theirs.
    Combination open = std::move(target.components);
    while (!open.empty()) {
      const std::int32_t pivot = rowOfPivot[static_cast<std::size_t>(open.back())];
      if (pivot < 0) {
        open.pop_back();
        continue;
      }
      target.changes = sumOf(target.changes, rows[static_cast<std::size_t>(pivot)].changes);
      open = sumOf(open, rows[static_cast<std::size_t>(pivot)].components);
    }
    for (const std::int32_t change : target.changes) {
      apply_[static_cast<std::size_t>(change)] = true;
      for (const std::int32_t f : changes_[static_cast<std::size_t>(change)].faces) {
        odd_[static_cast<std::size_t>(f)] = !odd_[static_cast<std::size_t>(f)];
      }
    }
  }

  /// Roots every tree and moves odd parity up to its root.
  void rootForest() {
    parent_.assign(ground_ + 1, {});
    depth_.assign(ground_ + 1, -1);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i <= ground_; ++i) {
      const std::size_t root = i == 0 ? ground_ : i - 1;
      if (depth_[root] >= 0) continue;
      depth_[root] = 0;
      parent_[root] = {root, 0};
      std::size_t next = order.size();
      order.push_back(root);
      for (; next < order.size(); ++next) {
        for (const Link& link : tree_[order[next]]) {
          if (depth_[link.node] >= 0) continue;
          depth_[link.node] = depth_[order[next]] + 1;
          parent_[link.node] = {order[next], link.change};
          order.push_back(link.node);
        }
      }
    }
    odd_.push_back(false);
    for (auto it = order.rbegin(); it != order.rend(); ++it) {
      if (!odd_[*it] || *it == ground_) continue;
      if (parent_[*it].node == *it) {
        ++oddFaces_;
        continue;
      }
      apply_[parent_[*it].change] = true;
      odd_[parent_[*it].node] = !odd_[parent_[*it].node];
    }
  }

  /// Toggles the cycle of a change outside the forest where that is cheaper. Bounded by a budget of steps.
  void improve() {
    constexpr int kPasses = 3;
    std::int64_t budget = 5'000'000;
    for (int pass = 0; pass < kPasses; ++pass) {
      bool improved = false;
      for (const std::size_t change : rest_) {
        std::vector<std::size_t> cycle{change};
        std::size_t a = firstEnd(change);
        std::size_t b = secondEnd(change);
        while (a != b) {
          std::size_t& lower = depth_[a] >= depth_[b] ? a : b;
          cycle.push_back(parent_[lower].change);
          lower = parent_[lower].node;
        }
        double gain = 0.0;
        for (const std::size_t c : cycle) gain += apply_[c] ? changes_[c].cost : -changes_[c].cost;
        budget -= static_cast<std::int64_t>(cycle.size());
        if (budget < 0) return;
        if (gain <= 1e-9) continue;
        for (const std::size_t c : cycle) apply_[c] = !apply_[c];
        improved = true;
      }
      if (!improved) return;
    }
  }

  struct Link {
    std::size_t node = 0;
    std::size_t change = 0;
  };

  const std::vector<ParityChange>& changes_;
  std::vector<bool> odd_;
  std::size_t ground_;
  std::vector<bool> apply_;
  Sets sets_;
  std::vector<std::size_t> order_;       ///< Changes, cheapest first.
  std::vector<std::vector<Link>> tree_;  ///< Per node: links of the forest.
  std::vector<std::size_t> rest_;        ///< Changes of one or two faces outside the forest.
  std::vector<Link> parent_;
  std::vector<std::int32_t> depth_;
  std::int64_t oddFaces_ = 0;
};

}  // namespace

ParitySolution solveParity(std::vector<bool> odd, const std::vector<ParityChange>& changes) {
  return ParityGraph(std::move(odd), changes).solve();
}

}  // namespace qmcf
