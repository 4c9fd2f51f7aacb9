#include "too_coarse.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace qmcf {
namespace {

SizeLimit halved(const std::vector<Vec3>& positions, const Element& element, std::int32_t face) {
  const std::size_t corners = cornerCount(element);
  const auto corner = [&](std::size_t c) { return positions[static_cast<std::size_t>(element[c % corners])]; };
  SizeLimit limit{face, {}, 0.0};
  for (std::size_t c = 0; c < corners; ++c) {
    limit.position = limit.position + corner(c) / static_cast<double>(corners);
    limit.size += 0.5 * distance(corner(c), corner(c + 1)) / static_cast<double>(corners);
  }
  return limit;
}

/// Checks that smaller elements can help with and that list elements.
constexpr std::array<std::string_view, 5> kAboutElements{"invertedElements", "facesTurnedOver", "duplicateElements",
                                                         "nonManifoldEdges", "orientationConflicts"};

}  // namespace

std::vector<SizeLimit> halvedAt(const FaceMesh& mesh, const std::vector<std::int32_t>& elements, std::int32_t face) {
  std::vector<SizeLimit> limits;
  for (const std::int32_t e : elements) {
    limits.push_back(halved(mesh.positions, mesh.elements[static_cast<std::size_t>(e)], face));
  }
  return limits;
}

std::vector<SizeLimit> halvedWhereInvalid(const QuadMesh& mesh, const QualityReport& quality) {
  std::vector<SizeLimit> limits;
  for (const ValidityCheck& check : quality.checks) {
    const bool isAboutElements =
        std::find(kAboutElements.begin(), kAboutElements.end(), check.name) != kAboutElements.end();
    if (check.status != CheckStatus::fail || !isAboutElements) continue;
    for (const std::int64_t id : check.elements) {
      const auto e = static_cast<std::size_t>(id);
      limits.push_back(halved(mesh.positions, mesh.elements[e], mesh.elementFace[e]));
    }
  }
  return limits;
}

std::vector<SizeLimit> notBelow(const std::vector<SizeLimit>& limits, double lowest) {
  std::vector<SizeLimit> result;
  for (const SizeLimit& limit : limits) {
    if (limit.size >= lowest) result.push_back(limit);
  }
  return result;
}

}  // namespace qmcf
