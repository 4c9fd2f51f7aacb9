#include "check.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "qmcf/base/bounding_box.hpp"

namespace qmcf::property {
namespace {

using Side = std::pair<std::int32_t, std::int32_t>;

Side undirected(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Elements per directed side, by nothing but the elements.
std::map<Side, int> sidesOf(const QuadMesh& mesh) {
  std::map<Side, int> sides;
  for (const Element& element : mesh.elements) {
    const std::size_t corners = cornerCount(element);
    for (std::size_t c = 0; c < corners; ++c) ++sides[{element[c], element[(c + 1) % corners]}];
  }
  return sides;
}

/// Counts of a mesh that has to be a surface.
class SurfaceCounts {
 public:
  explicit SurfaceCounts(const QuadMesh& mesh) : sides_(sidesOf(mesh)) {
    std::map<std::int32_t, int> elementsAt;
    for (const Element& element : mesh.elements) {
      if (cornerCount(element) == 3) ++ledger_;
      for (std::size_t c = 0; c < cornerCount(element); ++c) ++elementsAt[element[c]];
    }
    std::map<std::int32_t, std::int32_t> nextOnBoundary;
    std::size_t edges = 0;
    for (const auto& [side, uses] : sides_) {
      if (uses > 1) ++repeated_;
      const bool hasTwin = sides_.count({side.second, side.first}) != 0;
      if (!hasTwin) nextOnBoundary[side.second] = side.first;
      if (!hasTwin || side.first < side.second) ++edges;
    }
    for (const auto& [vertex, count] : elementsAt) ledger_ += (nextOnBoundary.count(vertex) != 0 ? 2 : 4) - count;
    euler_ = static_cast<std::int64_t>(elementsAt.size()) - static_cast<std::int64_t>(edges) +
             static_cast<std::int64_t>(mesh.elements.size());
    while (!nextOnBoundary.empty()) {
      ++loops_;
      for (auto at = nextOnBoundary.begin(); at != nextOnBoundary.end();) {
        const std::int32_t next = at->second;
        nextOnBoundary.erase(at);
        at = nextOnBoundary.find(next);
      }
    }
  }

  [[nodiscard]] std::int64_t repeated() const { return repeated_; }
  [[nodiscard]] std::int64_t euler() const { return euler_; }
  [[nodiscard]] std::int64_t ledger() const { return ledger_; }
  [[nodiscard]] std::int64_t loops() const { return loops_; }
  [[nodiscard]] int elementsAlong(std::int32_t a, std::int32_t b) const {
    const auto count = [this](Side side) {
      const auto found = sides_.find(side);
      return found == sides_.end() ? 0 : found->second;
    };
    return count({a, b}) + count({b, a});
  }

 private:
  std::map<Side, int> sides_;
  std::int64_t repeated_ = 0;
  std::int64_t euler_ = 0;
  std::int64_t ledger_ = 0;
  std::int64_t loops_ = 0;
};

void expect(std::vector<std::string>& faults, bool holds, const std::string& what) {
  if (!holds) faults.push_back(what);
}

void expectEqual(std::vector<std::string>& faults, std::int64_t is, std::int64_t wanted, const std::string& what) {
  expect(faults, is == wanted, what + " " + std::to_string(is) + ", not " + std::to_string(wanted));
}

/// Each edge of the part is a chain of the mesh's edges from its start to its end, with as many elements at each of
/// them as the edge has faces.
void checkFeatures(const Brep& brep, const QuadMesh& mesh, const SurfaceCounts& counts,
                   std::vector<std::string>& faults) {
  std::vector<std::map<std::int32_t, int>> ends(brep.edges.size());
  std::set<Side> seen;
  for (const FeatureSegment& segment : mesh.featureSegments) {
    const auto e = static_cast<std::size_t>(segment.edge);
    ++ends[e][segment.a];
    ++ends[e][segment.b];
    const int wanted = brep.edges[e].kind == EdgeKind::boundary ? 1 : 2;
    expectEqual(faults, counts.elementsAlong(segment.a, segment.b), wanted, "elements along a feature");
    expect(faults, seen.insert(undirected(segment.a, segment.b)).second, "two features have the same side");
  }
  for (std::size_t e = 0; e < ends.size(); ++e) {
    const bool closed = brep.edges[e].start == brep.edges[e].end;
    std::int64_t loose = 0;
    for (const auto& [vertex, count] : ends[e]) loose += count == 2 ? 0 : 1;
    expectEqual(faults, loose, closed ? 0 : 2, "loose ends of an edge:");
    expect(faults, ends[e].size() > 1, "an edge is missing");
  }
}

/// Each corner of the part is a vertex of the mesh, exactly.
void checkCorners(const InspectResult& input, const QuadMesh& mesh, std::vector<std::string>& faults) {
  const auto keyOf = [](const Vec3& p) { return std::array<double, 3>{p.x, p.y, p.z}; };
  std::set<std::array<double, 3>> places;
  for (const Vec3& p : mesh.positions) places.insert(keyOf(p));
  std::int64_t missing = 0;
  for (const BrepVertex& vertex : input.brep.vertices) {
    const Vec3& p = input.repaired.mesh.positions[static_cast<std::size_t>(vertex.point)];
    if (!vertex.artificial && places.count(keyOf(p)) == 0) ++missing;
  }
  expectEqual(faults, missing, 0, "missing corners");
}

/// Whether a step of the part is too low for its normal to mean anything: its edges are no features then
/// (docs/algorithm.md H2), and the report says that they are lost.
bool hasStepsTooLow(const TriangleMesh& part) {
  constexpr double kLowest = 20.0 * 2e-7;  // Of the diagonal.
  BoundingBox box;
  for (const Vec3& p : part.positions) box.include(p);
  const double lowest = kLowest * box.diagonal();
  return std::any_of(part.triangles.begin(), part.triangles.end(), [&](const auto& corners) {
    const Vec3& a = part.positions[static_cast<std::size_t>(corners[0])];
    const Vec3& b = part.positions[static_cast<std::size_t>(corners[1])];
    const Vec3& c = part.positions[static_cast<std::size_t>(corners[2])];
    const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
    return norm(cross(b - a, c - a)) <= lowest * longest;
  });
}

void checkRecall(const Case& made, const QualityReport& quality, std::vector<std::string>& faults) {
  // Chords of arcs in few divisions turn by up to the angle that counts, and corners of 45 degrees are a matter of
  // taste.
  constexpr double kLeast = 0.9;
  if (!hasStepsTooLow(made.part)) expect(faults, quality.sharpRecall.value_or(1.0) >= kLeast, "sharp edges are lost");
  expect(faults, quality.boundaryRecall.value_or(1.0) >= kLeast, "boundary is lost");
  expect(faults, quality.cornerRecall.value_or(1.0) >= kLeast, "corners are lost");
}

}  // namespace

std::vector<std::string> faultsOf(const Case& made, const MeshResult& result) {
  std::vector<std::string> faults;
  for (const ValidityCheck& check : result.quality.checks) {
    expect(faults, check.status != CheckStatus::fail, check.name + ": " + check.sentence);
  }
  expect(faults, result.quality.valid, "not valid");
  const SurfaceCounts counts(result.mesh);
  expectEqual(faults, counts.repeated(), 0, "sides with two elements the same way");
  expectEqual(faults, counts.euler(), made.eulerCharacteristic, "Euler characteristic");
  expectEqual(faults, counts.ledger(), 4 * made.eulerCharacteristic, "ledger");
  expectEqual(faults, counts.loops(), made.boundaryLoops, "boundary loops");
  expectEqual(faults, result.quality.components, made.components, "components");
  expect(faults, result.quality.ledger.closes(), "the reported ledger does not close");
  expectEqual(faults, result.quality.ledger.sum(), counts.ledger(), "reported ledger");
  if (made.options.allQuad) expectEqual(faults, result.quality.triangles, 0, "triangles");
  checkFeatures(result.input.brep, result.mesh, counts, faults);
  checkCorners(result.input, result.mesh, faults);
  checkRecall(made, result.quality, faults);
  return faults;
}

std::vector<std::string> runCase(const Case& made, Progress& progress, MeshResult* result) {
  auto meshed = meshSurface(made.part, made.options, progress);
  if (!meshed) return {"error: " + meshed.error().message};
  std::vector<std::string> faults = faultsOf(made, meshed.value());
  if (result != nullptr) *result = std::move(meshed).value();
  return faults;
}

std::string describe(const Case& made) {
  return made.name + ", " + std::to_string(made.part.triangles.size()) + " triangles, size " +
         std::to_string(*made.options.size) + ", " + std::string(modeName(made.options.mode)) +
         (made.options.allQuad ? ", quadrilaterals only" : "") +
         (made.options.curvature ? ", chord error " + std::to_string(*made.options.curvature) : "") +
         (made.options.sizes.empty() ? "" : ", sizes at vertices") +
         (made.options.fitSizes.value_or(false) ? ", sizes that fit the field" : "");
}

}  // namespace qmcf::property
