#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "qmcf/mesh/ids.hpp"
#include "qmcf/mesh/trace.hpp"

namespace qmcf::testing {

/// Does what a player of traces does, from their documentation alone, and checks each step.
class TraceReplay {
 public:
  using Edge = std::pair<std::int32_t, std::int32_t>;

  void apply(const TraceStep& step) {
    if (step.isReset) *this = {};
    for (const auto& loop : step.boundary) {
      for (std::size_t i = 0; i < loop.size(); ++i) boundary_.emplace(loop[i], loop[(i + 1) % loop.size()]);
    }
    for (const auto& [vertex, x, y, z] : step.vertices) positions[vertex] = {x, y, z};
    for (const std::int32_t e : step.removed) EXPECT_EQ(elements.erase(e), 1U);
    for (const auto& [e, a, b, c, d] : step.elements) elements[e] = {a, b, c, d};
    collectSides();
    expectClosedFront();
    const auto edges = frontEdges();
    for (const auto& [a, b, state] : step.states) {
      EXPECT_TRUE(edges.contains({a, b})) << a << " " << b;
      EXPECT_TRUE(state >= 0 && state <= 3);
    }
  }

  /// Directed so that the open region lies on the left.
  [[nodiscard]] std::set<Edge> frontEdges() const {
    std::set<Edge> front;
    for (const Edge& edge : boundary_) {
      if (!sides_.contains(edge)) front.insert(edge);
    }
    for (const auto& [a, b] : sides_) {
      if (!sides_.contains({b, a}) && !boundary_.contains({a, b})) front.emplace(b, a);
    }
    return front;
  }

  [[nodiscard]] std::int64_t count(bool quads) const {
    std::int64_t sum = 0;
    for (const auto& [e, corners] : elements) sum += (corners[3] != kNone) == quads ? 1 : 0;
    return sum;
  }

  std::map<std::int32_t, std::array<std::int32_t, 3>> positions;
  std::map<std::int32_t, std::array<std::int32_t, 4>> elements;

 private:
  void collectSides() {
    sides_.clear();
    for (const auto& [e, corners] : elements) {
      const std::size_t n = corners[3] == kNone ? 3 : 4;
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_TRUE(positions.contains(corners[i]));
        EXPECT_TRUE(sides_.emplace(corners[i], corners[(i + 1) % n]).second) << "two elements on one side of an edge";
      }
    }
  }

  /// The front is loops: as many of its edges end at a vertex as leave it.
  void expectClosedFront() const {
    std::map<std::int32_t, int> excess;
    for (const auto& [a, b] : frontEdges()) {
      ++excess[a];
      --excess[b];
    }
    for (const auto& [v, n] : excess) EXPECT_EQ(n, 0) << "the front is not closed at vertex " << v;
  }

  std::set<Edge> boundary_;
  std::set<Edge> sides_;
};

}  // namespace qmcf::testing
