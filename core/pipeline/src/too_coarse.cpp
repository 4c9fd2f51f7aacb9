#include "too_coarse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>
#include <string_view>

#include "qmcf/spatial/triangle_bvh.hpp"

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

template <class Visit>
void forEachElementAtFault(const QualityReport& quality, Visit visit) {
  for (const ValidityCheck& check : quality.checks) {
    const bool isAboutElements =
        std::find(kAboutElements.begin(), kAboutElements.end(), check.name) != kAboutElements.end();
    if (check.status != CheckStatus::fail || !isAboutElements) continue;
    for (const std::int64_t id : check.elements) visit(static_cast<std::size_t>(id));
  }
}

Element sorted(Element element) {
  std::sort(element.begin(), element.end());
  return element;
}

/// The check of duplicates lists all but the first of them.
template <class Visit>
void forEachFirstOfDuplicates(const QuadMesh& mesh, const QualityReport& quality, Visit visit) {
  std::set<Element> listed;
  for (const ValidityCheck& check : quality.checks) {
    if (check.name != "duplicateElements" || check.status != CheckStatus::fail) continue;
    for (const std::int64_t id : check.elements) listed.insert(sorted(mesh.elements[static_cast<std::size_t>(id)]));
  }
  if (listed.empty()) return;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (listed.erase(sorted(mesh.elements[e])) > 0) visit(e);
  }
}

bool failsToCover(const QualityReport& quality) {
  return std::any_of(quality.checks.begin(), quality.checks.end(), [](const ValidityCheck& check) {
    return check.name == "coverage" && check.status == CheckStatus::fail;
  });
}

double areaOf(const QuadMesh& mesh, const Element& element) {
  const auto p = [&](std::size_t i) -> const Vec3& { return mesh.positions[static_cast<std::size_t>(element[i])]; };
  const bool isQuad = cornerCount(element) == 4;
  return 0.5 * norm(isQuad ? cross(p(2) - p(0), p(3) - p(1)) : cross(p(1) - p(0), p(2) - p(0)));
}

/// Per face, whether the area of its mesh is far from that of the face. Omitted faces have nothing to miss.
std::vector<std::uint8_t> poorlyCovered(const QuadMesh& mesh, const Brep& brep) {
  constexpr double kMostDifference = 0.15;
  std::vector<double> areas(brep.faces.size(), 0.0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    areas[static_cast<std::size_t>(mesh.elementFace[e])] += areaOf(mesh, mesh.elements[e]);
  }
  std::vector<std::uint8_t> result(brep.faces.size(), 0);
  for (std::size_t f = 0; f < areas.size(); ++f) {
    const double wanted = brep.faces[f].area;
    result[f] = areas[f] > 0.0 && std::fabs(areas[f] - wanted) > kMostDifference * wanted ? 1 : 0;
  }
  return result;
}

/// The elements of a face, and which is nearest to what of the part.
class NearestElements {
 public:
  /// \pre the face's elements have area.
  NearestElements(const QuadMesh& mesh, std::int32_t face) {
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      if (mesh.elementFace[e] != face) continue;
      const Element& element = mesh.elements[e];
      elements_.push_back(static_cast<std::int32_t>(e));
      areas_.push_back(areaOf(mesh, element));
      for (std::size_t c = 2; c < cornerCount(element); ++c) {
        triangles.push_back({element[0], element[c - 1], element[c]});
        elementOf_.push_back(elements_.size() - 1);
      }
    }
    below_.assign(elements_.size(), 0.0);
    piece_ = std::accumulate(areas_.begin(), areas_.end(), 0.0) / (kPieces * static_cast<double>(areas_.size()));
    tree_ = TriangleBvh(mesh.positions, triangles);
  }

  /// Gives the area of a triangle of the part, piece by piece, to the elements nearest to the pieces.
  void give(const Vec3& a, const Vec3& b, const Vec3& c) {
    constexpr int kMostRows = 64;
    const double area = 0.5 * norm(cross(b - a, c - a));
    const int rows = static_cast<int>(std::clamp(std::ceil(std::sqrt(area / piece_)), 1.0, double{kMostRows}));
    const auto take = [&](double i, double j) {
      const Vec3 place = a + (b - a) * (i / rows) + (c - a) * (j / rows);
      below_[elementOf_[static_cast<std::size_t>(tree_.closest(place).triangle)]] += area / (rows * rows);
    };
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; i + j < rows; ++j) {
        take(i + 1.0 / 3.0, j + 1.0 / 3.0);
        if (i + j + 1 < rows) take(i + 2.0 / 3.0, j + 2.0 / 3.0);
      }
    }
  }

  /// The elements whose area is far from what they were given, all if this is so for none.
  [[nodiscard]] std::vector<std::int32_t> poor() const {
    constexpr double kMost = 0.3;  // Of what they were given.
    std::vector<std::int32_t> result;
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      if (std::fabs(below_[i] - areas_[i]) > kMost * below_[i]) result.push_back(elements_[i]);
    }
    return result.empty() ? elements_ : result;
  }

 private:
  static constexpr double kPieces = 16.0;  ///< Per element.

  std::vector<std::int32_t> elements_;
  std::vector<std::size_t> elementOf_;  ///< Per triangle of the tree, an index into elements_.
  std::vector<double> areas_;
  std::vector<double> below_;  ///< What each was given.
  double piece_ = 0.0;         ///< The largest area that is given as a whole.
  TriangleBvh tree_;
};

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
  forEachElementAtFault(
      quality, [&](std::size_t e) { limits.push_back(halved(mesh.positions, mesh.elements[e], mesh.elementFace[e])); });
  return limits;
}

std::vector<SizeLimit> halvedWhereMissing(const QuadMesh& mesh, const QualityReport& quality, const TriangleMesh& part,
                                          const Brep& brep) {
  std::vector<SizeLimit> limits;
  if (!failsToCover(quality)) return limits;
  const std::vector<std::uint8_t> poor = poorlyCovered(mesh, brep);
  for (std::size_t f = 0; f < poor.size(); ++f) {
    if (poor[f] == 0) continue;
    const auto face = static_cast<std::int32_t>(f);
    NearestElements nearest(mesh, face);
    for (const std::int32_t t : brep.faces[f].triangles) {
      const auto corner = [&](std::size_t c) {
        return part.positions[static_cast<std::size_t>(part.triangles[static_cast<std::size_t>(t)][c])];
      };
      nearest.give(corner(0), corner(1), corner(2));
    }
    for (const std::int32_t e : nearest.poor()) {
      limits.push_back(halved(mesh.positions, mesh.elements[static_cast<std::size_t>(e)], face));
    }
  }
  return limits;
}

std::vector<SizeLimit> halvedWhereMissed(const std::vector<Vec3>& places, const TriangleMesh& mesh, const Brep& brep,
                                         const SizeField& size) {
  constexpr double kApart = 2.0;  // In units of the limit.
  std::vector<SizeLimit> limits;
  if (places.empty()) return limits;
  const TriangleBvh tree(mesh.positions, mesh.triangles);
  for (const Vec3& place : places) {
    const ClosestPoint closest = tree.closest(place);
    const auto t = static_cast<std::size_t>(closest.triangle);
    SizeLimit limit{brep.triangleFace[t], place, 0.0};
    for (std::size_t c = 0; c < 3; ++c) {
      limit.size += 0.5 * closest.barycentric[c] * size.value[static_cast<std::size_t>(mesh.triangles[t][c])];
    }
    const bool isNear = std::any_of(limits.begin(), limits.end(), [&](const SizeLimit& other) {
      return other.face == limit.face && distance(other.position, place) < kApart * other.size;
    });
    if (!isNear) limits.push_back(limit);
  }
  return limits;
}

std::vector<std::int32_t> facesAtFault(const QuadMesh& mesh, const QualityReport& quality, const Brep& brep) {
  std::vector<std::uint8_t> atFault =
      failsToCover(quality) ? poorlyCovered(mesh, brep) : std::vector<std::uint8_t>(brep.faces.size(), 0);
  const auto mark = [&](std::size_t e) { atFault[static_cast<std::size_t>(mesh.elementFace[e])] = 1; };
  forEachElementAtFault(quality, mark);
  // Either of two layers with the same elements may be the one that can be made another way.
  forEachFirstOfDuplicates(mesh, quality, mark);
  std::vector<std::int32_t> faces;
  for (std::size_t f = 0; f < atFault.size(); ++f) {
    if (atFault[f] != 0) faces.push_back(static_cast<std::int32_t>(f));
  }
  return faces;
}

std::int64_t countFaults(const QualityReport& quality) {
  std::int64_t count = 0;
  for (const ValidityCheck& check : quality.checks) count += check.status == CheckStatus::fail ? check.count : 0;
  return count;
}

std::vector<SizeLimit> halvedAtTriangles(const QuadMesh& mesh) {
  std::vector<SizeLimit> limits;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (cornerCount(mesh.elements[e]) == 3)
      limits.push_back(halved(mesh.positions, mesh.elements[e], mesh.elementFace[e]));
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
