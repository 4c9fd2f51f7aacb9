#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "repair_state.hpp"

namespace qmcf::detail {

/// Local edits of the soup under repair that never open a crack: all triangles around an edge or a vertex change at
/// once. Triangles only die or are appended; finish() compacts them.
class EditSoup {
 public:
  explicit EditSoup(RepairState& state);

  [[nodiscard]] bool alive(std::int32_t triangle) const { return alive_[static_cast<std::size_t>(triangle)] != 0; }
  /// How many triangles all calls so far have looked at: what they took.
  [[nodiscard]] std::size_t looked() const { return looked_; }
  /// Living triangles with the edge ab, ascending.
  [[nodiscard]] std::vector<std::int32_t> trianglesAt(std::int32_t a, std::int32_t b) const;

  /// Merging a and b keeps the surface's topology: they share no neighbours but those of the triangles at their edge.
  [[nodiscard]] bool mayMerge(std::int32_t a, std::int32_t b) const;
  /// Moves every triangle from `gone` to `kept`; triangles that had both die. Returns the others.
  std::vector<std::int32_t> merge(std::int32_t kept, std::int32_t gone);
  /// Splits every triangle at the edge ab in two at v; a triangle abv dies: it lies on the split edge.
  /// Returns the triangles that changed or are new.
  std::vector<std::int32_t> splitEdge(std::int32_t a, std::int32_t b, std::int32_t v);
  void kill(std::int32_t triangle) { alive_[static_cast<std::size_t>(triangle)] = 0; }
  /// Appends a vertex.
  std::int32_t addVertex(const Vec3& position);
  /// Removes the dead triangles from the state. The object must not be used afterwards.
  void finish();

 private:
  /// The triangles at v; may contain dead ones and ones that have left v.
  [[nodiscard]] const std::vector<std::int32_t>& around(std::int32_t v) const;
  /// Of two vertices the one with fewer triangles, then the other.
  [[nodiscard]] std::array<std::int32_t, 2> fewerFirst(std::int32_t a, std::int32_t b) const;
  [[nodiscard]] bool hasBoth(std::int32_t triangle, std::int32_t a, std::int32_t b) const;
  [[nodiscard]] bool areConnected(std::int32_t a, std::int32_t b) const;

  RepairState& state_;
  std::vector<std::uint8_t> alive_;
  std::vector<std::vector<std::int32_t>> around_;
  mutable std::size_t looked_ = 0;
};

}  // namespace qmcf::detail
