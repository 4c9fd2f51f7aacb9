#include "vertex_sizes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "qmcf/spatial/triangle_bvh.hpp"

namespace qmcf {
namespace {

/// Sizes by the exact place of a vertex.
class SizesAtPoints {
 public:
  SizesAtPoints(const std::vector<double>& sizes, const TriangleMesh& input) {
    std::vector<bool> isUsed(input.positions.size(), false);
    for (const auto& t : input.triangles) {
      for (const std::int32_t v : t) isUsed[static_cast<std::size_t>(v)] = true;
    }
    for (std::size_t v = 0; v < sizes.size(); ++v) {
      if (isUsed[v]) entries_.emplace_back(place(input.positions[v]), sizes[v]);
    }
    std::sort(entries_.begin(), entries_.end());
  }

  /// The smallest size there.
  [[nodiscard]] std::optional<double> at(const Vec3& p) const {
    const Entry first{place(p), 0.0};
    const auto found = std::lower_bound(entries_.begin(), entries_.end(), first);
    if (found == entries_.end() || found->first != first.first) return std::nullopt;
    return found->second;
  }

 private:
  using Place = std::array<double, 3>;
  using Entry = std::pair<Place, double>;

  static Place place(const Vec3& p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0}; }  // -0 becomes 0.

  std::vector<Entry> entries_;
};

}  // namespace

Result<std::vector<double>> sizesOfRepaired(const std::vector<double>& sizes, const TriangleMesh& input,
                                            const TriangleMesh& repaired) {
  if (sizes.size() != input.positions.size()) {
    return Error{ErrorCode::invalidOption,
                 "There must be one size for each of the model's " + std::to_string(input.positions.size()) +
                     " vertices, not " + std::to_string(sizes.size()) + ".",
                 {}};
  }
  const SizesAtPoints known(sizes, input);
  std::optional<TriangleBvh> tree;
  std::vector<double> result;
  result.reserve(repaired.positions.size());
  for (const Vec3& p : repaired.positions) {
    if (const std::optional<double> size = known.at(p)) {
      result.push_back(*size);
      continue;
    }
    if (!tree) tree.emplace(input.positions, input.triangles);
    const ClosestPoint near = tree->closest(p);
    const auto& corners = input.triangles[static_cast<std::size_t>(near.triangle)];
    double size = 0.0;
    for (std::size_t c = 0; c < 3; ++c) size += near.barycentric[c] * sizes[static_cast<std::size_t>(corners[c])];
    result.push_back(size);
  }
  return result;
}

}  // namespace qmcf
