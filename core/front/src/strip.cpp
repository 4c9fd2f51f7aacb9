#include "qmcf/front/strip.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "qmcf/mesh/element_shape.hpp"

namespace qmcf {
namespace {

// A face is narrow while its width, twice its area over its outline, is less than this many edges of the outline.
constexpr double kMostWidth = 1.6;
constexpr std::size_t kMostNodes = 4000;
constexpr std::size_t kMostLoops = 12;
// Chords are at most this many times the width, or the sizes at their ends, whichever is more.
constexpr double kReach = 2.2;
// The face turns by at most 60 degrees between the ends of a chord.
constexpr double kLeastNormal = 0.5;
// No element has a smaller shape.
constexpr double kLeastShape = 0.1;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Vertices of a mesh in a closed row, the face on its left.
using Polygon = std::vector<std::int32_t>;

/// The boundary of a face: a mesh without elements, and its loops.
struct Outline {
  FaceMesh mesh;
  std::vector<double> size;  ///< Per vertex: the element length wanted.
  std::vector<Polygon> loops;
  double length = 0.0;
  double width = 0.0;  ///< Of the face: twice its area over the length of the outline.
};

Outline outlineOf(const Patch& patch) {
  const Surface& surface = patch.surface;
  Outline outline;
  for (const HalfedgeId first : surface.boundaryLoops()) {
    Polygon& loop = outline.loops.emplace_back();
    HalfedgeId h = first;
    do {
      const VertexId v = surface.origin(h);
      SurfacePoint location{Surface::triangle(h), {0.0, 0.0, 0.0}};
      location.barycentric[static_cast<std::size_t>(h.value % 3)] = 1.0;
      loop.push_back(static_cast<std::int32_t>(outline.mesh.positions.size()));
      outline.mesh.positions.push_back(surface.position(v));
      outline.mesh.normals.push_back(patch.normal[v]);
      outline.mesh.locations.push_back(location);
      outline.mesh.patchVertex.push_back(v.value);
      outline.size.push_back(patch.size[v]);
      outline.length += surface.length(h);
      h = surface.nextBoundary(h);
    } while (h != first);
  }
  double area = 0.0;
  for (const TriangleId t : surface.triangles()) area += 0.5 * norm(surface.areaVector(t));
  outline.width = 2.0 * area / outline.length;
  return outline;
}

bool isNarrow(const Outline& outline) {
  const std::size_t nodes = outline.mesh.positions.size();
  return nodes > 0 && nodes <= kMostNodes && outline.loops.size() <= kMostLoops &&
         outline.width < kMostWidth * outline.length / static_cast<double>(nodes);
}

/// The loops as one polygon, joined along the shortest ways between them, nearest first. A vertex where a way ends
/// occurs twice.
Polygon joinLoops(const Outline& outline) {
  const auto& p = outline.mesh.positions;
  std::vector<Polygon> loops = outline.loops;
  Polygon polygon = std::move(loops.front());
  loops.erase(loops.begin());
  while (!loops.empty()) {
    double least = kInfinite;
    std::array<std::size_t, 3> best{};  // Place in the polygon, loop, place in the loop.
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      for (std::size_t l = 0; l < loops.size(); ++l) {
        for (std::size_t j = 0; j < loops[l].size(); ++j) {
          const double way = squaredNorm(p[at(polygon[i])] - p[at(loops[l][j])]);
          if (!(way < least)) continue;
          least = way;
          best = {i, l, j};
        }
      }
    }
    Polygon& loop = loops[best[1]];
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(best[2]), loop.end());
    loop.push_back(loop.front());
    loop.push_back(polygon[best[0]]);
    polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(best[0]) + 1, loop.begin(), loop.end());
    loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(best[1]));
  }
  return polygon;
}

/// The cheapest way to mesh what a chord, or an edge of the polygon, cuts off.
struct Cut {
  double cost = kInfinite;
  std::int32_t first = kNone;   ///< Place of the third corner of the element at the chord.
  std::int32_t second = kNone;  ///< Of the fourth; kNone: a triangle.
};

/// Cuts the polygon of an outline into elements. Places are indices into the polygon; a chord from place a to place
/// b > a cuts off the places between them.
class PolygonCutter {
 public:
  explicit PolygonCutter(const Outline& outline) : outline_(outline), polygon_(joinLoops(outline)) {}

  /// The elements of the cheapest mesh; none where there is no mesh.
  std::vector<Element> run() {
    findChords();
    cutAll();
    return elements();
  }

 private:
  [[nodiscard]] const Vec3& position(std::int32_t place) const {
    return outline_.mesh.positions[at(polygon_[at(place)])];
  }
  [[nodiscard]] const Vec3& normal(std::int32_t place) const { return outline_.mesh.normals[at(polygon_[at(place)])]; }
  [[nodiscard]] double size(std::int32_t place) const { return outline_.size[at(polygon_[at(place)])]; }

  void findChords() {
    const auto n = static_cast<std::int32_t>(polygon_.size());
    chords_.resize(polygon_.size());
    cuts_.resize(polygon_.size());
    for (std::int32_t a = 0; a < n; ++a) {
      for (std::int32_t b = a + 1; b < n; ++b) {
        const bool isEdge = b == a + 1 || (a == 0 && b == n - 1);
        if (isEdge || isChord(a, b)) chords_[at(a)].push_back(b);
      }
      cuts_[at(a)].resize(chords_[at(a)].size());
    }
  }

  [[nodiscard]] bool isChord(std::int32_t a, std::int32_t b) const {
    const double reach = kReach * std::max({outline_.width, size(a), size(b)});
    if (squaredNorm(position(a) - position(b)) > reach * reach || dot(normal(a), normal(b)) < kLeastNormal)
      return false;
    const std::int32_t v = polygon_[at(a)];
    const std::int32_t w = polygon_[at(b)];
    const std::size_t n = polygon_.size();
    const auto isNext = [&](std::int32_t place, std::int32_t vertex) {
      return polygon_[(at(place) + 1) % n] == vertex || polygon_[(at(place) + n - 1) % n] == vertex;
    };
    return v != w && !isNext(a, w) && !isNext(b, v);
  }

  /// What is known of the chord or edge from a to b; nullptr where there is none.
  [[nodiscard]] Cut* cutOf(std::int32_t a, std::int32_t b) {
    const auto& ends = chords_[at(a)];
    const auto it = std::lower_bound(ends.begin(), ends.end(), b);
    if (it == ends.end() || *it != b) return nullptr;
    return &cuts_[at(a)][static_cast<std::size_t>(it - ends.begin())];
  }

  /// From chords that cut off little to those that cut off much.
  void cutAll() {
    std::vector<std::array<std::int32_t, 3>> byPlaces;
    for (std::size_t a = 0; a < chords_.size(); ++a) {
      const auto from = static_cast<std::int32_t>(a);
      for (const std::int32_t b : chords_[a]) byPlaces.push_back({b - from, from, b});
    }
    std::sort(byPlaces.begin(), byPlaces.end());
    for (const auto& [places, a, b] : byPlaces) {
      Cut& cut = *cutOf(a, b);
      if (places == 1) {
        cut.cost = 0.0;
      } else {
        cutBest(a, b, cut);
      }
    }
  }

  void cutBest(std::int32_t a, std::int32_t b, Cut& best) {
    const auto& ends = chords_[at(a)];
    for (std::size_t i = 0; i < ends.size() && ends[i] < b; ++i) {
      const std::int32_t k = ends[i];
      const double before = cuts_[at(a)][i].cost;
      if (!(before < best.cost)) continue;
      if (const Cut* rest = cutOf(k, b)) take(best, before + rest->cost, {a, k, b, kNone});
      const auto& next = chords_[at(k)];
      for (std::size_t j = 0; j < next.size() && next[j] < b; ++j) {
        const Cut* rest = cutOf(next[j], b);
        if (rest != nullptr) take(best, before + cuts_[at(k)][j].cost + rest->cost, {a, k, next[j], b});
      }
    }
  }

  /// Takes an element if it is the best so far; rest: the cost of what is beyond its other sides.
  void take(Cut& best, double rest, const Element& places) const {
    const bool isTriangle = cornerCount(places) == 3;
    if (!(rest < best.cost)) return;
    const Element element = atVertices(places);
    for (std::size_t c = 0; c < cornerCount(element); ++c) {
      for (std::size_t d = 0; d < c; ++d) {
        if (element[c] == element[d]) return;
      }
    }
    const double shape = elementShape(outline_.mesh, element, filledCorners(places));
    const double cost = rest + shapeCost(shape, isTriangle);
    if (shape < kLeastShape || !(cost < best.cost)) return;
    best = {cost, places[1], isTriangle ? kNone : places[2]};
  }

  /// Per corner, whether the element is alone there: its neighbours in the polygon are corners of it, too.
  [[nodiscard]] std::array<bool, 4> filledCorners(const Element& places) const {
    std::array<bool, 4> fills{};
    const std::size_t corners = cornerCount(places);
    const auto isNext = [&](std::int32_t place, std::int32_t next) {
      return at(place + 1) % polygon_.size() == at(next);
    };
    for (std::size_t c = 0; c < corners; ++c) {
      fills[c] = isNext(places[c], places[(c + 1) % corners]) && isNext(places[(c + corners - 1) % corners], places[c]);
    }
    return fills;
  }

  [[nodiscard]] Element atVertices(Element places) const {
    for (std::int32_t& corner : places) {
      if (corner != kNone) corner = polygon_[at(corner)];
    }
    return places;
  }

  [[nodiscard]] std::vector<Element> elements() {
    std::vector<Element> made;
    std::vector<std::array<std::int32_t, 2>> open{{0, static_cast<std::int32_t>(polygon_.size()) - 1}};
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      if (b == a + 1) continue;
      const Cut* cut = cutOf(a, b);
      if (cut == nullptr || !(cut->cost < kInfinite)) return {};
      const bool isTriangle = cut->second == kNone;
      made.push_back(
          atVertices(isTriangle ? Element{a, cut->first, b, kNone} : Element{a, cut->first, cut->second, b}));
      open.push_back({a, cut->first});
      if (!isTriangle) open.push_back({cut->first, cut->second});
      open.push_back({isTriangle ? cut->first : cut->second, b});
    }
    return made;
  }

  const Outline& outline_;
  Polygon polygon_;
  std::vector<std::vector<std::int32_t>> chords_;  ///< Per place: the later ends of chords and edges, ascending.
  std::vector<std::vector<Cut>> cuts_;             ///< Per chord.
};

/// Whether the elements join as the face itself does. A chord that was taken on both ways around a hole is two of the
/// polygon and one edge of the mesh.
bool isLike(const Surface& surface, const FaceMesh& mesh) {
  std::vector<std::array<std::int32_t, 2>> halves;
  std::vector<std::array<std::int32_t, 2>> edges;
  for (const Element& element : mesh.elements) {
    const std::size_t n = cornerCount(element);
    for (std::size_t c = 0; c < n; ++c) {
      const auto [low, high] = std::minmax(element[c], element[(c + 1) % n]);
      halves.push_back({element[c], element[(c + 1) % n]});
      edges.push_back({low, high});
    }
  }
  std::sort(halves.begin(), halves.end());
  if (std::adjacent_find(halves.begin(), halves.end()) != halves.end()) return false;
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const auto faces = static_cast<std::int64_t>(mesh.positions.size() + mesh.elements.size());
  return faces - static_cast<std::int64_t>(edges.size()) == surface.eulerCharacteristic();
}

}  // namespace

std::optional<FaceMesh> meshStrip(const Patch& patch) {
  Outline outline = outlineOf(patch);
  if (!isNarrow(outline)) return std::nullopt;
  // Cutting along the ways between the loops makes a disc of a face without handles only.
  if (patch.surface.eulerCharacteristic() != 2 - static_cast<std::int64_t>(outline.loops.size())) return std::nullopt;
  outline.mesh.elements = PolygonCutter(outline).run();
  if (outline.mesh.elements.empty() || !isLike(patch.surface, outline.mesh)) return std::nullopt;
  return std::move(outline.mesh);
}

}  // namespace qmcf
