#include <algorithm>
#include <array>
#include <numeric>

#include "repair_state.hpp"
#include "triangle_edges.hpp"

namespace qmcf::detail {
namespace {

/// Sign of the permutation that sorts the corners: equal for triangles of the same orientation.
bool isOdd(const std::array<std::int32_t, 3>& c) {
  return (static_cast<int>(c[0] > c[1]) + static_cast<int>(c[1] > c[2]) + static_cast<int>(c[0] > c[2])) % 2 != 0;
}

/// Triangles grouped by their three vertices: each run of equal keys is a group, ascending by triangle.
std::vector<std::pair<std::array<std::int32_t, 3>, std::int32_t>> sortedByVertices(const Triangles& triangles) {
  std::vector<std::pair<std::array<std::int32_t, 3>, std::int32_t>> keys;
  keys.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    auto key = triangles[t];
    std::sort(key.begin(), key.end());
    keys.emplace_back(key, static_cast<std::int32_t>(t));
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// Marks in `keep` one triangle per set of vertices; in `folded` those that had a partner of the other orientation.
void keepFirstOfEach(const RepairState& state, std::vector<std::uint8_t>& keep, std::vector<std::uint8_t>& folded,
                     RepairItem& item) {
  const auto keys = sortedByVertices(state.mesh.triangles);
  for (std::size_t i = 0, end = 0; i < keys.size(); i = end) {
    const auto kept = static_cast<std::size_t>(keys[i].second);
    for (end = i + 1; end < keys.size() && keys[end].first == keys[i].first; ++end) {
      const auto t = static_cast<std::size_t>(keys[end].second);
      keep[t] = 0;
      if (isOdd(state.mesh.triangles[t]) != isOdd(state.mesh.triangles[kept])) {
        folded[kept] = 1;
      } else {
        note(item, state.origin[t]);
      }
    }
  }
}

std::int32_t rootOf(std::vector<std::int32_t>& parent, std::int32_t t) {
  while (parent[static_cast<std::size_t>(t)] != t) {
    auto& p = parent[static_cast<std::size_t>(t)];
    p = parent[static_cast<std::size_t>(p)];
    t = p;
  }
  return t;
}

/// A folded patch (both sides of it were there) that hangs on an otherwise closed surface is a fin that the surface
/// does without; one that closes or continues something is a zero-thickness sheet of which one side stays.
void dropFins(const RepairState& state, const std::vector<std::uint8_t>& folded, std::vector<std::uint8_t>& keep) {
  // Only the triangles that stay so far; the fold counts once.
  Triangles kept;
  std::vector<std::size_t> source;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    if (keep[t] == 0) continue;
    kept.push_back(state.mesh.triangles[t]);
    source.push_back(t);
  }
  const TriangleEdges edges(kept, state.mesh.positions.size());
  std::vector<std::int32_t> parent(kept.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto isFolded = [&](HalfedgeId h) { return folded[source[Surface::triangle(h).index()]] != 0; };
  for (const EdgeId e : edges.edges()) {
    std::int32_t first = kNone;
    for (const HalfedgeId h : edges.uses(e)) {
      if (!isFolded(h)) continue;
      const std::int32_t root = rootOf(parent, Surface::triangle(h).value);
      if (first == kNone) first = root;
      parent[static_cast<std::size_t>(std::max(root, first))] = std::min(root, first);
      first = std::min(root, first);
    }
  }
  std::vector<std::uint8_t> attached(kept.size(), 0);
  std::vector<std::uint8_t> needed(kept.size(), 0);
  for (const EdgeId e : edges.edges()) {
    const auto uses = edges.uses(e);
    const auto others = std::count_if(uses.begin(), uses.end(), [&](HalfedgeId h) { return !isFolded(h); });
    if (others == static_cast<std::ptrdiff_t>(uses.size()) || others == 0) continue;
    const HalfedgeId h = *std::find_if(uses.begin(), uses.end(), isFolded);
    const auto root = static_cast<std::size_t>(rootOf(parent, Surface::triangle(h).value));
    (others % 2 == 0 ? attached : needed)[root] = 1;
  }
  for (std::size_t t = 0; t < kept.size(); ++t) {
    const auto root = static_cast<std::size_t>(rootOf(parent, static_cast<std::int32_t>(t)));
    if (folded[source[t]] != 0 && attached[root] != 0 && needed[root] == 0) keep[source[t]] = 0;
  }
}

}  // namespace

void removeDuplicates(RepairState& state) {
  const std::size_t count = state.mesh.triangles.size();
  std::vector<std::uint8_t> keep(count, 1);
  std::vector<std::uint8_t> folded(count, 0);
  RepairItem duplicates{"duplicateTriangles", state.modify ? "removed" : "found", 0, {}};
  keepFirstOfEach(state, keep, folded, duplicates);
  addItem(state, std::move(duplicates));

  if (std::find(folded.begin(), folded.end(), 1) != folded.end()) {
    dropFins(state, folded, keep);
    RepairItem sheets{"zeroThicknessSheets", state.modify ? "one of the two sides kept" : "found", 0, {}};
    RepairItem fins{"zeroThicknessFins", state.modify ? "removed" : "found", 0, {}};
    for (std::size_t t = 0; t < count; ++t) {
      if (folded[t] != 0) note(keep[t] != 0 ? sheets : fins, state.origin[t]);
    }
    addItem(state, std::move(sheets));
    addItem(state, std::move(fins));
  }
  if (state.modify) keepTriangles(state, keep);
}

}  // namespace qmcf::detail
