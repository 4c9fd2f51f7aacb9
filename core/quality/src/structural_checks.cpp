#include "structural_checks.hpp"

#include <algorithm>
#include <tuple>

namespace qmcf::quality {
namespace {

std::int64_t firstElement(const EdgeTable& table, const EdgeRecord& edge) { return table.usesOf(edge)[0].element; }

template <class Wanted>
std::vector<std::int64_t> elementsAtEdges(const EdgeTable& table, Wanted wanted) {
  std::vector<std::int64_t> result;
  for (std::size_t i = 0; i < table.edges.size(); ++i) {
    if (wanted(i, table.edges[i])) result.push_back(firstElement(table, table.edges[i]));
  }
  return result;
}

/// A quad with a smaller scaled Jacobian may be folded over once its coordinates are written and read.
constexpr double kNoShape = 1e-9;

bool hasNoShape(const QuadMesh& mesh, const Element& element) {
  const auto at = [&](std::size_t corner) -> const Vec3& {
    return mesh.positions[static_cast<std::size_t>(element[corner])];
  };
  if (cornerCount(element) == 3) return !(triangleScaledJacobian(at(0), at(1), at(2)) > 0.0);
  return !(quadScaledJacobian(at(0), at(1), at(2), at(3)) > kNoShape);
}

std::vector<std::int64_t> unreferencedVertices(const QuadMesh& mesh) {
  std::vector<std::uint8_t> referenced(mesh.positions.size(), 0);
  for (const Element& element : mesh.elements) {
    for (const std::int32_t v : element) {
      if (v >= 0 && static_cast<std::size_t>(v) < referenced.size()) referenced[static_cast<std::size_t>(v)] = 1;
    }
  }
  std::vector<std::int64_t> result;
  for (std::size_t v = 0; v < referenced.size(); ++v) {
    if (referenced[v] == 0) result.push_back(static_cast<std::int64_t>(v));
  }
  return result;
}

/// Index of the edge between two vertices in the table, or the number of edges if there is none.
std::size_t findEdge(const EdgeTable& table, std::int32_t a, std::int32_t b) {
  const std::int32_t low = std::min(a, b);
  const std::int32_t high = std::max(a, b);
  const auto found =
      std::lower_bound(table.edges.begin(), table.edges.end(), std::tie(low, high),
                       [](const EdgeRecord& edge, const std::tuple<const std::int32_t&, const std::int32_t&>& key) {
                         return std::tie(edge.low, edge.high) < key;
                       });
  const bool hit = found != table.edges.end() && found->low == low && found->high == high;
  return static_cast<std::size_t>((hit ? found : table.edges.end()) - table.edges.begin());
}

/// Marks of what lies on feature segments.
struct FeatureMarks {
  std::vector<std::uint8_t> edge;    ///< Per edge of the table.
  std::vector<std::uint8_t> vertex;  ///< Per vertex of the mesh.
};

FeatureMarks markFeatures(const QuadMesh& mesh, const EdgeTable& table) {
  FeatureMarks marks;
  marks.edge.assign(table.edges.size(), 0);
  marks.vertex.assign(mesh.positions.size(), 0);
  for (const FeatureSegment& segment : mesh.featureSegments) {
    const std::size_t edge = findEdge(table, segment.a, segment.b);
    if (edge == table.edges.size()) continue;
    marks.edge[edge] = 1;
    marks.vertex[static_cast<std::size_t>(segment.a)] = 1;
    marks.vertex[static_cast<std::size_t>(segment.b)] = 1;
  }
  return marks;
}

}  // namespace

void addElementChecks(const QuadMesh& mesh, const Screening& screening, CheckList& checks) {
  const bool empty = std::find(screening.usable.begin(), screening.usable.end(), 1) == screening.usable.end();
  checks.addCount("empty", CheckStatus::fail, empty ? 1 : 0, "The mesh has no usable element.");
  checks.add("indexOutOfRange", CheckStatus::fail, screening.outOfRange,
             "elements name a vertex that does not exist (elements listed)");
  checks.add("nonFiniteCoordinate", CheckStatus::fail, screening.nonFiniteVertices,
             "vertices have a coordinate that is not a finite number (vertices listed)");
  checks.add("repeatedCorner", CheckStatus::fail, screening.repeatedCorner,
             "elements name a vertex twice (elements listed)");
  checks.add("duplicateElements", CheckStatus::fail, findDuplicates(mesh.elements, screening.usable),
             "elements have the same vertices as an earlier one (elements listed)");
  checks.add("unreferencedVertices", CheckStatus::warn, unreferencedVertices(mesh),
             "vertices have no element (vertices listed)");
  std::vector<std::int64_t> inverted;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (screening.usable[e] != 0 && hasNoShape(mesh, mesh.elements[e])) {
      inverted.push_back(static_cast<std::int64_t>(e));
    }
  }
  checks.add("invertedElements", CheckStatus::fail, inverted,
             "elements are folded over or have no area at a corner (elements listed)");
}

void addSegmentCheck(const QuadMesh& mesh, const Structure& structure, CheckList& checks) {
  std::vector<std::int64_t> missing;
  for (const FeatureSegment& segment : mesh.featureSegments) {
    if (findEdge(structure.edges, segment.a, segment.b) == structure.edges.edges.size()) missing.push_back(segment.a);
  }
  checks.add("featureSegments", CheckStatus::fail, missing,
             "feature segments are no edges of the mesh (their first vertices listed)");
}

void addManifoldChecks(const QuadMesh& mesh, const Structure& structure, CheckList& checks) {
  const EdgeTable& table = structure.edges;
  const FeatureMarks marks = markFeatures(mesh, table);
  checks.add("nonManifoldEdges", CheckStatus::fail,
             elementsAtEdges(
                 table, [&](std::size_t i, const EdgeRecord& edge) { return edge.useCount > 2 && marks.edge[i] == 0; }),
             "edges off the features have more than two elements (one element of each listed)");
  std::vector<std::int64_t> pinched = pinchedVertices(structure);
  std::erase_if(pinched, [&](std::int64_t v) { return marks.vertex[static_cast<std::size_t>(v)] != 0; });
  checks.add("nonManifoldVertices", CheckStatus::warn, pinched,
             "vertices off the features join elements that share no edge there (vertices listed)");
  const auto conflicts = [&](std::uint8_t onFeature) {
    return elementsAtEdges(table, [&, onFeature](std::size_t i, const EdgeRecord& edge) {
      return marks.edge[i] == onFeature && isOrientationConflict(table, edge);
    });
  };
  // A one-sided surface has to change sides somewhere; then that is at a cut, which is a feature.
  const std::vector<std::int64_t> inside = conflicts(0);
  checks.add("orientationConflicts", inside.empty() ? CheckStatus::warn : CheckStatus::fail,
             inside.empty() ? conflicts(1) : inside,
             "edges lie between elements that face opposite sides (one element of each listed)");
}

std::vector<std::int64_t> pinchedVertices(const Structure& structure) {
  std::vector<std::int64_t> result;
  for (std::size_t v = 0; v < structure.fans.size(); ++v) {
    if (structure.fans[v] > 1) result.push_back(static_cast<std::int64_t>(v));
  }
  return result;
}

std::vector<std::int64_t> orientationConflicts(const Structure& structure) {
  return elementsAtEdges(structure.edges, [&](std::size_t, const EdgeRecord& edge) {
    return isOrientationConflict(structure.edges, edge);
  });
}

std::vector<std::int64_t> nonManifoldEdges(const Structure& structure) {
  return elementsAtEdges(structure.edges, [](std::size_t, const EdgeRecord& edge) { return edge.useCount > 2; });
}

}  // namespace qmcf::quality

namespace qmcf {

ValidityReport validateMesh(const QuadMesh& mesh) {
  const quality::Screening screening = quality::screenElements(mesh.positions, mesh.elements);
  const quality::Structure structure = quality::buildStructure(mesh.positions, mesh.elements, screening.usable);
  quality::CheckList checks;
  quality::addElementChecks(mesh, screening, checks);
  quality::addSegmentCheck(mesh, structure, checks);
  quality::addManifoldChecks(mesh, structure, checks);
  return std::move(checks).report();
}

}  // namespace qmcf
