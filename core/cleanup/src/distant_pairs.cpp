// Triangles far from each other become quads together with all that lies on a way between them: along a row of
// quadrilaterals that is a shear by one element, with irregular vertices at its ends and where it turns only.
#include <algorithm>
#include <array>
#include <cstddef>

#include "cavity.hpp"
#include "operators.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "triangle_paths.hpp"

namespace qmcf {
namespace {

constexpr std::size_t kMostPaths = 4;
constexpr int kSettleSweeps = 12;
/// Unless there were worse ones before.
constexpr double kLeastShape = 0.3;
/// How much of the mean shape around the path two triangles less are worth.
constexpr double kWorth = 0.1;

double meanShapeAround(const EditMesh& mesh, const std::vector<VertexId>& vertices) {
  const std::vector<FaceId> faces = facesAround(mesh, vertices);
  double sum = 0.0;
  for (const FaceId f : faces) sum += faceShape(mesh, f);
  return sum / static_cast<double>(faces.size());
}

/// The quads as for EditMesh::fill(), of a region whose boundary has these vertices.
std::vector<std::array<int, 4>> cellsOf(const std::vector<std::array<VertexId, 4>>& quads,
                                        const std::vector<VertexId>& boundary) {
  std::vector<std::array<int, 4>> cells;
  for (const auto& quad : quads) {
    auto& cell = cells.emplace_back();
    for (std::size_t i = 0; i < cell.size(); ++i) {
      cell[i] = static_cast<int>(std::find(boundary.begin(), boundary.end(), quad[i]) - boundary.begin());
    }
  }
  return cells;
}

}  // namespace

bool TopologicalCleanup::joinAlong(const TrianglePath& path) {
  cavity_.clear();
  for (const HalfedgeId h : path) cavity_.add(mesh_.face(h));
  cavity_.add(mesh_.face(mesh_.twin(path.back())));
  const auto loop = cavity_.boundaryLoop(mesh_);
  // A path that touches itself has other edges inside than those that are crossed.
  if (!loop || loop->size() != 2 * path.size() + 2) return false;
  std::vector<VertexId> vertices;
  for (const HalfedgeId h : *loop) vertices.push_back(mesh_.origin(h));
  const auto cells = cellsOf(quadsAlong(mesh_, path), vertices);
  if (cavity_.doublesEdge(mesh_, *loop, cells)) return false;
  const auto energy = [&] {
    int sum = 0;
    for (const VertexId v : vertices) sum += irregularity(mesh_.isBoundary(v), excess(v));
    return sum;
  };
  const int energyBefore = energy() + 2 * kTriangleEnergy;
  const std::vector<VertexId> near = withNeighbours(mesh_, vertices);
  const std::vector<VertexId> moving = withNeighbours(mesh_, near);
  const double least = std::min(worstAround(mesh_, near), kLeastShape);
  const double mean = meanShapeAround(mesh_, near);
  const std::size_t mark = mesh_.mark();
  mesh_.fill(*loop, cavity_.faces(), cells, {});
  const auto isGood = [&] {
    if (energy() > energyBefore) return false;
    for (int sweep = 0; sweep < kSettleSweeps; ++sweep) relax(mesh_, moving, target_, options_.leastShape);
    return worstAround(mesh_, near) >= least && meanShapeAround(mesh_, near) >= mean - kWorth;
  };
  if (!isGood()) {
    mesh_.rollback(mark);
    return false;
  }
  touched_.insert(touched_.end(), moving.begin(), moving.end());
  mesh_.commit();
  ++statistics_.pairs;
  return true;
}

std::int64_t TopologicalCleanup::pathPass() {
  if (countElements(mesh_).triangles > kFewTriangles) return 0;
  std::int64_t changes = 0;
  note(TraceKind::pair);
  for (std::size_t i = 0; i < mesh_.faceCapacity(); ++i) {
    const FaceId f(i);
    if (mesh_.kind(f) == FaceKind::removed || mesh_.cornerCount(f) != 3) continue;
    for (const TrianglePath& path : pathsToTriangles(mesh_, f, kMostPaths)) {
      // Shorter ones are bridged by the small operators, with any quads that fit.
      if (path.size() <= kLongestBridge + 1 || !joinAlong(path)) continue;
      ++changes;
      break;
    }
  }
  return changes;
}

}  // namespace qmcf
