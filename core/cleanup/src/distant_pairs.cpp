// Triangles far from each other become quads together with all that lies on a way between them: along a row of
// quadrilaterals that is a shear by one element, with irregular vertices at its ends and where it turns only.
#include <algorithm>
#include <cstddef>

#include "cavity.hpp"
#include "operators.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "triangle_ways.hpp"

namespace qmcf {
namespace {

constexpr std::size_t kMostWays = 4;
/// Some 57 squares in a row.
constexpr double kMostCost = 6.0;
constexpr int kSettleSweeps = 12;
/// What a pair may leave, unless there were worse elements before, and how much of the mean shape around the way it is
/// worth.
constexpr double kLeastShape = 0.3;
constexpr double kWorth = 0.1;

double meanShapeAround(const EditMesh& mesh, const std::vector<VertexId>& vertices) {
  const std::vector<FaceId> faces = facesAround(mesh, vertices);
  double sum = 0.0;
  for (const FaceId f : faces) sum += faceShape(mesh, f);
  return sum / static_cast<double>(faces.size());
}

}  // namespace

bool TopologicalCleanup::joinAlong(const TriangleWay& way, const PairLimits& limits) {
  std::vector<FaceId> faces{mesh_.face(mesh_.twin(way.crossed.back()))};
  for (const HalfedgeId h : way.crossed) faces.push_back(mesh_.face(h));
  const std::vector<VertexId> vertices = cornersOf(mesh_, faces);
  const auto energy = [&] {
    int sum = 0;
    for (const VertexId v : vertices) sum += irregularity(mesh_.isBoundary(v), excess(v));
    return sum;
  };
  const int energyBefore = energy() + 2 * kTriangleEnergy;
  const std::vector<VertexId> near = withNeighbours(mesh_, vertices);
  const std::vector<VertexId> moving = withNeighbours(mesh_, near);
  const double least = std::min(worstAround(mesh_, near), limits.leastShape);
  const double mean = meanShapeAround(mesh_, near);
  const std::size_t mark = mesh_.mark();
  const std::size_t touchedBefore = touched_.size();
  const auto isGood = [&] {
    if (!mergeAlong(mesh_, way)) return false;
    if (!limits.atAnyPrice && energy() > energyBefore) return false;
    for (int sweep = 0; sweep < kSettleSweeps; ++sweep) relax(mesh_, moving, target_, options_.leastShape);
    if (limits.atAnyPrice) return mendPoor(near, least);
    return worstAround(mesh_, near) >= least && meanShapeAround(mesh_, near) >= mean - kWorth;
  };
  if (!isGood()) {
    mesh_.rollback(mark);
    touched_.resize(touchedBefore);
    return false;
  }
  touched_.insert(touched_.end(), moving.begin(), moving.end());
  mesh_.commit();
  ++statistics_.pairs;
  return true;
}

std::int64_t TopologicalCleanup::distantPass() {
  if (countElements(mesh_).triangles > kFewTriangles) return 0;
  std::int64_t changes = 0;
  note(TraceKind::pair);
  for (std::size_t i = 0; i < mesh_.faceCapacity(); ++i) {
    const FaceId f(i);
    if (mesh_.kind(f) == FaceKind::removed || mesh_.cornerCount(f) != 3) continue;
    for (const TriangleWay& way : waysToTriangles(mesh_, f, kMostWays, kMostCost)) {
      // Shorter ones are bridged by the small operators, with any quads that fit.
      if (way.crossed.size() <= kLongestBridge + 1 || !joinAlong(way, {kLeastShape, false})) continue;
      ++changes;
      break;
    }
  }
  return changes;
}

}  // namespace qmcf
