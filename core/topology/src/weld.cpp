#include "weld.hpp"

#include <cstdint>

#include "qmcf/base/bits.hpp"
#include "qmcf/mesh/ids.hpp"
#include "repair_state.hpp"

namespace qmcf::detail {
namespace {

std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

/// Adding 0.0 turns -0 into 0.
std::uint64_t hashOf(const Vec3& p) {
  const auto x = bitCast<std::uint64_t>(p.x + 0.0);
  const auto y = bitCast<std::uint64_t>(p.y + 0.0);
  const auto z = bitCast<std::uint64_t>(p.z + 0.0);
  return mix(mix(mix(x + 0x9E3779B97F4A7C15ULL) + y) + z);
}

}  // namespace

std::vector<std::int32_t> firstAtSamePoint(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> used(mesh.positions.size(), 0);
  for (const auto& corners : mesh.triangles) {
    for (const std::int32_t v : corners) used[static_cast<std::size_t>(v)] = 1;
  }
  // Open addressing; which slot a point falls into does not influence the result, only who comes first does.
  std::size_t slots = 1;
  while (slots < 2 * mesh.positions.size() + 1) slots *= 2;
  std::vector<std::int32_t> table(slots, kNone);
  std::vector<std::int32_t> first(mesh.positions.size(), kNone);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (used[v] == 0) continue;
    std::size_t slot = static_cast<std::size_t>(hashOf(mesh.positions[v])) & (slots - 1);
    while (table[slot] >= 0 && !(mesh.positions[static_cast<std::size_t>(table[slot])] == mesh.positions[v])) {
      slot = (slot + 1) & (slots - 1);
    }
    if (table[slot] < 0) table[slot] = static_cast<std::int32_t>(v);
    first[v] = table[slot];
  }
  return first;
}

bool isTriangleList(const TriangleMesh& mesh) {
  if (mesh.positions.size() != 3 * mesh.triangles.size()) return false;
  std::int32_t next = 0;
  for (const auto& corners : mesh.triangles) {
    for (const std::int32_t v : corners) {
      if (v != next++) return false;
    }
  }
  return true;
}

void weldExact(RepairState& state) {
  TriangleMesh& mesh = state.mesh;
  RepairItem item = isTriangleList(mesh)
                        ? RepairItem{"unsharedVertices", "merged: the format stores each triangle by itself", 0, {}}
                        : RepairItem{"duplicateVertices", "merged", 0, {}};
  const std::vector<std::int32_t> first = firstAtSamePoint(mesh);
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (first[v] >= 0 && static_cast<std::size_t>(first[v]) != v) note(item, static_cast<std::int64_t>(v));
  }
  for (auto& corners : mesh.triangles) {
    for (std::int32_t& v : corners) v = first[static_cast<std::size_t>(v)];
  }
  addItem(state, std::move(item));
}

}  // namespace qmcf::detail
