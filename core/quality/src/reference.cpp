#include "reference.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "qmcf/base/bits.hpp"
#include "qmcf/base/bounding_box.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/mesh/sharp_angle.hpp"
#include "screening.hpp"

namespace qmcf::quality {
namespace {

/// A triangle is a sliver when its smallest height is at most this part of its longest edge or of the diagonal.
constexpr double kSliverOfEdge = 1e-6;
constexpr double kSliverOfDiagonal = 2.5e-7;
constexpr double kCornerTurn = 45.0;  ///< Degrees.

std::uint64_t hashOf(const Vec3& p) {
  std::uint64_t h = 0;
  for (const double x : {p.x, p.y, p.z}) {
    // Adding 0 makes -0 and 0 the same.
    h = (h ^ bitCast<std::uint64_t>(x + 0.0)) * 0x9E3779B97F4A7C15ULL;
    h ^= h >> 29U;
  }
  return h;
}

/// Gives each different position among those used a number, in order of first use.
class ExactWelder {
 public:
  explicit ExactWelder(std::size_t most) : slots_(std::bit_ceil(2 * most + 16), kNone) {}

  std::int32_t add(const Vec3& p) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = static_cast<std::size_t>(hashOf(p)) & mask;
    while (slots_[slot] != kNone && !(positions_[static_cast<std::size_t>(slots_[slot])] == p))
      slot = (slot + 1) & mask;
    if (slots_[slot] == kNone) {
      slots_[slot] = static_cast<std::int32_t>(positions_.size());
      positions_.push_back(p);
    }
    return slots_[slot];
  }
  std::vector<Vec3> takePositions() { return std::move(positions_); }

 private:
  std::vector<std::int32_t> slots_;
  std::vector<Vec3> positions_;
};

void weld(const TriangleMesh& mesh, Reference& reference) {
  std::vector<Element> elements;
  elements.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) elements.push_back({triangle[0], triangle[1], triangle[2], kNone});
  const Screening screening = screenElements(mesh.positions, elements);
  ExactWelder welder(mesh.positions.size());
  std::vector<std::int32_t> welded(mesh.positions.size(), kNone);
  for (std::size_t t = 0; t < elements.size(); ++t) {
    if (screening.usable[t] == 0) continue;
    Element element{kNone, kNone, kNone, kNone};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto v = static_cast<std::size_t>(elements[t][c]);
      if (welded[v] == kNone) welded[v] = welder.add(mesh.positions[v]);
      element[c] = welded[v];
    }
    const bool collapsed = element[0] == element[1] || element[1] == element[2] || element[2] == element[0];
    if (!collapsed) reference.triangles.push_back(element);
  }
  reference.positions = welder.takePositions();
}

double diagonalOf(const std::vector<Vec3>& positions) {
  if (positions.empty()) return 0.0;
  BoundingBox box;
  for (const Vec3& p : positions) box.include(p);
  return box.diagonal();
}

/// Normals, area and the tree over the triangles whose normals can be trusted.
void measureTriangles(Reference& reference) {
  std::vector<std::array<std::int32_t, 3>> solid;
  solid.reserve(reference.triangles.size());
  reference.normals.reserve(reference.triangles.size());
  for (std::size_t t = 0; t < reference.triangles.size(); ++t) {
    const Element& triangle = reference.triangles[t];
    const Vec3& a = reference.positions[static_cast<std::size_t>(triangle[0])];
    const Vec3& b = reference.positions[static_cast<std::size_t>(triangle[1])];
    const Vec3& c = reference.positions[static_cast<std::size_t>(triangle[2])];
    const Vec3 areaVector = cross(b - a, c - a);
    const double doubleArea = norm(areaVector);
    const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
    const double height = longest > 0.0 ? doubleArea / longest : 0.0;
    const bool sliver = height <= kSliverOfEdge * longest || height <= kSliverOfDiagonal * reference.diagonal;
    reference.area += 0.5 * doubleArea;
    reference.normals.push_back(sliver ? Vec3{} : areaVector / doubleArea);
    if (sliver) continue;
    solid.push_back({triangle[0], triangle[1], triangle[2]});
    reference.bvhTriangle.push_back(static_cast<std::int32_t>(t));
  }
  reference.bvh = TriangleBvh(reference.positions, solid);
}

/// Whether the edge's two triangles enclose more than the angle given by its cosine.
bool isSharp(const Reference& reference, const EdgeRecord& edge, double cosine) {
  const auto uses = reference.structure.edges.usesOf(edge);
  const Vec3& m = reference.normals[static_cast<std::size_t>(uses[0].element)];
  const Vec3& n = reference.normals[static_cast<std::size_t>(uses[1].element)];
  if (reference.isSliver(uses[0].element) || reference.isSliver(uses[1].element)) return false;
  const double side = uses[0].forward == uses[1].forward ? -1.0 : 1.0;
  return side * dot(m, n) < cosine;
}

/// Directions of the feature edges away from each vertex that has any.
struct Spoke {
  std::int32_t vertex = kNone;
  std::int32_t edge = kNone;
  Vec3 direction;
};

std::vector<Vec3> findCorners(const Reference& reference, std::vector<Spoke> spokes) {
  std::sort(spokes.begin(), spokes.end(),
            [](const Spoke& a, const Spoke& b) { return std::pair(a.vertex, a.edge) < std::pair(b.vertex, b.edge); });
  const double straightest = math::cos(kCornerTurn * math::kPi / 180.0);
  std::vector<Vec3> corners;
  for (std::size_t first = 0; first < spokes.size();) {
    std::size_t last = first;
    while (last < spokes.size() && spokes[last].vertex == spokes[first].vertex) ++last;
    const bool turns = last - first == 2 && -dot(spokes[first].direction, spokes[first + 1].direction) < straightest;
    if (last - first != 2 || turns)
      corners.push_back(reference.positions[static_cast<std::size_t>(spokes[first].vertex)]);
    first = last;
  }
  return corners;
}

}  // namespace

Reference buildReference(const TriangleMesh& mesh) {
  Reference reference;
  weld(mesh, reference);
  reference.diagonal = diagonalOf(reference.positions);
  const std::vector<std::uint8_t> all(reference.triangles.size(), 1);
  reference.structure = buildStructure(reference.positions, reference.triangles, all);
  const EdgeTable& table = reference.structure.edges;
  reference.oriented = std::none_of(table.edges.begin(), table.edges.end(),
                                    [&](const EdgeRecord& edge) { return isOrientationConflict(table, edge); });
  reference.seams = findSeams(reference.positions, reference.structure, reference.diagonal);
  measureTriangles(reference);
  return reference;
}

ReferenceFeatures findFeatures(const Reference& reference, double featureAngle) {
  const double cosine = math::cos(leastSharpAngle(featureAngle));
  ReferenceFeatures features;
  std::vector<Spoke> spokes;
  const auto& edges = reference.structure.edges.edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const EdgeRecord& edge = edges[i];
    if (edge.useCount == 2 && !isSharp(reference, edge, cosine)) continue;
    auto& list = edge.useCount == 1 ? features.boundary : edge.useCount == 2 ? features.sharp : features.nonManifold;
    const Vec3& low = reference.positions[static_cast<std::size_t>(edge.low)];
    const Vec3& high = reference.positions[static_cast<std::size_t>(edge.high)];
    list.push_back({low, high});
    const Vec3 direction = normalized(high - low);
    spokes.push_back({edge.low, static_cast<std::int32_t>(i), direction});
    spokes.push_back({edge.high, static_cast<std::int32_t>(i), -direction});
  }
  features.corners = findCorners(reference, std::move(spokes));
  return features;
}

}  // namespace qmcf::quality
