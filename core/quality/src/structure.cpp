#include "structure.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "disjoint_sets.hpp"

namespace qmcf::quality {
namespace {

/// One side of one element on its way into the edge table.
struct Side {
  std::int32_t high = kNone;
  EdgeUse use;
};

template <class Visit>
void forEachSide(const std::vector<Element>& elements, const std::vector<std::uint8_t>& usable, Visit visit) {
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (usable[e] == 0) continue;
    const std::size_t corners = cornerCount(elements[e]);
    for (std::size_t c = 0; c < corners; ++c) {
      const std::int32_t from = elements[e][c];
      const std::int32_t to = elements[e][(c + 1) % corners];
      visit(std::min(from, to),
            Side{std::max(from, to), {static_cast<std::int32_t>(e), static_cast<std::int8_t>(c), from < to}});
    }
  }
}

/// Sorts all sides into one bucket per lower vertex, then each bucket, which is short, by the higher one.
EdgeTable buildEdges(std::size_t vertexCount, const std::vector<Element>& elements,
                     const std::vector<std::uint8_t>& usable) {
  std::vector<std::int32_t> start(vertexCount + 1, 0);
  forEachSide(elements, usable, [&](std::int32_t low, const Side&) { ++start[static_cast<std::size_t>(low) + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Side> sides(static_cast<std::size_t>(start.back()));
  std::vector<std::int32_t> cursor(start.begin(), start.end() - 1);
  forEachSide(elements, usable, [&](std::int32_t low, const Side& side) {
    sides[static_cast<std::size_t>(cursor[static_cast<std::size_t>(low)]++)] = side;
  });

  EdgeTable table;
  table.uses.reserve(sides.size());
  table.edges.reserve(sides.size() / 2 + 16);
  for (std::size_t v = 0; v < vertexCount; ++v) {
    const auto first = sides.begin() + start[v];
    const auto last = sides.begin() + start[v + 1];
    std::sort(first, last, [](const Side& a, const Side& b) {
      return std::tie(a.high, a.use.element, a.use.corner) < std::tie(b.high, b.use.element, b.use.corner);
    });
    for (auto side = first; side != last; ++side) {
      if (side == first || side->high != std::prev(side)->high) {
        table.edges.push_back(
            {static_cast<std::int32_t>(v), side->high, static_cast<std::int32_t>(table.uses.size()), 0});
      }
      ++table.edges.back().useCount;
      table.uses.push_back(side->use);
    }
  }
  return table;
}

/// Joins the corners of neighbouring elements at both ends of every edge; what remains apart at a vertex is a fan.
std::vector<std::int32_t> countFans(std::size_t vertexCount, const std::vector<Element>& elements,
                                    const std::vector<std::uint8_t>& usable, const EdgeTable& table) {
  constexpr std::int32_t kStride = 4;
  DisjointSets corners(elements.size() * kStride);
  const auto cornerAt = [&](const EdgeUse& use, bool atLow) {
    const auto count = static_cast<std::int32_t>(cornerCount(elements[static_cast<std::size_t>(use.element)]));
    const std::int32_t corner = use.forward == atLow ? use.corner : (use.corner + 1) % count;
    return use.element * kStride + corner;
  };
  for (const EdgeRecord& edge : table.edges) {
    const auto uses = table.usesOf(edge);
    for (const EdgeUse& use : uses.subspan(1)) {
      corners.join(cornerAt(uses[0], true), cornerAt(use, true));
      corners.join(cornerAt(uses[0], false), cornerAt(use, false));
    }
  }
  std::vector<std::int32_t> fans(vertexCount, 0);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (usable[e] == 0) continue;
    for (std::size_t c = 0; c < cornerCount(elements[e]); ++c) {
      const auto corner = static_cast<std::int32_t>(e * kStride + c);
      if (corners.root(corner) == corner) ++fans[static_cast<std::size_t>(elements[e][c])];
    }
  }
  return fans;
}

std::int64_t countComponents(const Structure& structure) {
  DisjointSets sets(structure.elementsAround.size());
  for (const EdgeRecord& edge : structure.edges.edges) sets.join(edge.low, edge.high);
  std::int64_t count = 0;
  for (std::size_t v = 0; v < structure.elementsAround.size(); ++v) {
    const auto id = static_cast<std::int32_t>(v);
    if (structure.elementsAround[v] > 0 && sets.root(id) == id) ++count;
  }
  return count;
}

}  // namespace

bool isOrientationConflict(const EdgeTable& table, const EdgeRecord& edge) {
  const auto uses = table.usesOf(edge);
  return uses.size() == 2 && uses[0].forward == uses[1].forward;
}

Structure buildStructure(const std::vector<Vec3>& positions, const std::vector<Element>& elements,
                         const std::vector<std::uint8_t>& usable) {
  const std::size_t vertexCount = positions.size();
  Structure structure;
  structure.edges = buildEdges(vertexCount, elements, usable);
  structure.elementsAround.assign(vertexCount, 0);
  std::int64_t elementCount = 0;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (usable[e] == 0) continue;
    ++elementCount;
    for (std::size_t c = 0; c < cornerCount(elements[e]); ++c) {
      ++structure.elementsAround[static_cast<std::size_t>(elements[e][c])];
    }
  }
  structure.fans = countFans(vertexCount, elements, usable, structure.edges);
  structure.onBoundary.assign(vertexCount, 0);
  structure.onNonManifold.assign(vertexCount, 0);
  for (const EdgeRecord& edge : structure.edges.edges) {
    if (edge.useCount == 2) continue;
    const auto low = static_cast<std::size_t>(edge.low);
    const auto high = static_cast<std::size_t>(edge.high);
    auto& mark = edge.useCount == 1 ? structure.onBoundary : structure.onNonManifold;
    mark[low] = 1;
    mark[high] = 1;
    (edge.useCount == 1 ? structure.boundaryLength : structure.nonManifoldLength) +=
        distance(positions[low], positions[high]);
  }
  structure.components = countComponents(structure);
  const auto used = std::count_if(structure.elementsAround.begin(), structure.elementsAround.end(),
                                  [](std::int32_t count) { return count > 0; });
  structure.eulerCharacteristic = used - static_cast<std::int64_t>(structure.edges.edges.size()) + elementCount;
  return structure;
}

}  // namespace qmcf::quality
