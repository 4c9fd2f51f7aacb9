// Cavity remeshing, after Verma and Suresh 2017: a region around irregular vertices grows until its outline is convex
// and is then filled with a pattern of at most two irregular vertices.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "cavity.hpp"
#include "operators.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/mesh/side_pattern.hpp"

namespace qmcf {
namespace {

constexpr std::size_t kLargestCavity = 150;
/// A pattern may leave elements this bad where there were no worse ones before.
constexpr double kGoodShape = 0.45;
/// How much of the mean shape a more regular mesh is worth.
constexpr double kRegularityWorth = 0.03;
constexpr double kNoTriangleWorth = 0.1;
/// Energy of two irregular vertices, and how many patterns with two are tried.
constexpr int kTwoEnergy = 2;
constexpr std::size_t kMostTries = 6;
/// How much distortion, summed over the elements, a unit of energy is worth; and how much more stretch, and loss of
/// mean shape, a pattern may cost before it is relaxed to be tried at all.
constexpr double kDistortionWorth = 1.0;
constexpr double kPromisedStretch = 6.5;
constexpr double kPromisedLoss = 0.2;
constexpr int kSettleSweeps = 12;
constexpr int kRoughSweeps = 10;  ///< Of these, on the patch.
/// A sweep lowers the distortion by at most this share of what the one before did. What can't get there is given up.
constexpr double kNextGain = 0.85;

/// How much the number of elements of a cavity may change, and the area that it must keep: what is less bridges a limb.
constexpr double kCountChange = 0.12;
constexpr double kAreaKept = 0.95;
/// Distance from the face, in element sizes, that never matters.
constexpr double kNear = 0.05;

/// Shapes of faces.
struct Shapes {
  double worst = 1.0;
  double mean = 0.0;
};

Shapes shapesOf(const EditMesh& mesh, const std::vector<FaceId>& faces) {
  Shapes shapes;
  for (const FaceId f : faces) {
    const double shape = faceShape(mesh, f);
    shapes.worst = std::min(shapes.worst, shape);
    shapes.mean += shape;
  }
  shapes.mean /= static_cast<double>(faces.size());
  return shapes;
}

/// How much longer one pair of sides of a quadrilateral is than the other: the ratio less 1.
double stretch(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3) {
  const double a = distance(p0, p1) + distance(p2, p3);
  const double b = distance(p1, p2) + distance(p3, p0);
  return std::max(a, b) / std::min(a, b) - 1.0;
}

/// Sum of stretch() over the quadrilaterals.
double stretchOf(const EditMesh& mesh, const std::vector<FaceId>& faces) {
  double sum = 0.0;
  for (const FaceId f : faces) {
    const auto sides = mesh.sides(f);
    if (!sides[3].valid()) continue;
    const auto p = [&](std::size_t i) -> const Vec3& { return mesh.position(mesh.origin(sides[i])); };
    sum += stretch(p(0), p(1), p(2), p(3));
  }
  return sum;
}

/// The area that is wanted of each element.
std::vector<double> wantedAreas(const EditMesh& mesh, const std::vector<FaceId>& faces,
                                const RelaxationTarget& target) {
  std::vector<double> areas;
  areas.reserve(faces.size());
  for (const FaceId f : faces) {
    const double size = wantedSize(target, mesh.vertex(mesh.origin(mesh.sides(f)[0])));
    areas.push_back(size * size);
  }
  return areas;
}

/// Sum over the quadrilaterals of stretch() and of how much larger or smaller they are than wanted: the ratio of the
/// areas less 1.
double distortionOf(const EditMesh& mesh, const std::vector<FaceId>& faces, const std::vector<double>& wantedAreas) {
  double sum = 0.0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto sides = mesh.sides(faces[i]);
    if (!sides[3].valid()) continue;
    const auto p = [&](std::size_t c) -> const Vec3& { return mesh.position(mesh.origin(sides[c])); };
    const double area = 0.5 * norm(cross(p(2) - p(0), p(3) - p(1)));
    sum += stretch(p(0), p(1), p(2), p(3));
    sum += std::max(area, wantedAreas[i]) / std::min(area, wantedAreas[i]) - 1.0;
  }
  return sum;
}

/// What a pattern promises before its vertices are on the face and relaxed.
struct Promise {
  double stretch = 0.0;    ///< As stretchOf().
  double meanShape = 0.0;  ///< Of the scaled Jacobians.
};

Promise promiseOf(const SidePattern& pattern, std::vector<Vec3> positions) {
  positions.insert(positions.end(), pattern.inner.begin(), pattern.inner.end());
  Promise promise;
  for (const auto& cell : pattern.cells) {
    const auto p = [&](std::size_t i) -> const Vec3& { return positions[static_cast<std::size_t>(cell[i % 4])]; };
    promise.stretch += stretch(p(0), p(1), p(2), p(3));
    const Vec3 normal = normalized(cross(p(2) - p(0), p(3) - p(1)));
    double shape = 1.0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 forward = p(i + 1) - p(i);
      const Vec3 backward = p(i + 3) - p(i);
      shape = std::min(shape, dot(cross(forward, backward), normal) / (norm(forward) * norm(backward)));
    }
    promise.meanShape += shape / static_cast<double>(pattern.cells.size());
  }
  return promise;
}

double areaOf(const EditMesh& mesh, const std::vector<FaceId>& faces) {
  double area = 0.0;
  for (const FaceId f : faces) {
    const auto sides = mesh.sides(f);
    // A triangle counts as a quad with its last corner twice.
    const auto p = [&](std::size_t i) -> const Vec3& {
      return mesh.position(mesh.origin(sides[sides[i].valid() ? i : 2]));
    };
    area += 0.5 * norm(cross(p(2) - p(0), p(3) - p(1)));
  }
  return area;
}

std::vector<Vec3> centresOf(const EditMesh& mesh, const std::vector<FaceId>& faces) {
  std::vector<Vec3> centres;
  centres.reserve(faces.size());
  for (const FaceId f : faces) {
    const auto sides = mesh.sides(f);
    const auto p = [&](std::size_t i) -> const Vec3& { return mesh.position(mesh.origin(sides[i])); };
    centres.push_back((p(0) + p(1) + p(2) + (sides[3].valid() ? p(3) : Vec3{})) / (sides[3].valid() ? 4.0 : 3.0));
  }
  return centres;
}

/// The largest distance of the points from the face.
double distanceOf(const std::vector<Vec3>& points, const TriangleBvh& face) {
  double largest = 0.0;
  for (const Vec3& p : points) largest = std::max(largest, face.closest(p).squaredDistance);
  return std::sqrt(largest);
}

/// How far the distortion will have fallen after so many more sweeps if each lowers it by kNextGain of what the one
/// before did.
double foreseen(double distortion, double before, int sweeps) {
  double gain = std::max(before - distortion, 0.0);
  for (int i = 0; i < sweeps; ++i) {
    gain *= kNextGain;
    distortion -= gain;
  }
  return distortion;
}

}  // namespace

/// Elements that the cavity would have to have at each vertex of its loop for the vertex to be regular.
std::vector<int> TopologicalCleanup::wantedInside(const std::vector<HalfedgeId>& loop) const {
  std::vector<int> wanted;
  wanted.reserve(loop.size());
  for (const HalfedgeId h : loop) {
    const VertexId v = mesh_.origin(h);
    wanted.push_back(cavity_.countAround(mesh_, v) - excess(v));
  }
  return wanted;
}

/// Adds the faces around the vertices to the cavity. Returns whether there were any.
bool TopologicalCleanup::grow(const std::vector<VertexId>& around) {
  const std::size_t before = cavity_.size();
  for (const VertexId v : around) {
    mesh_.forEachOutgoing(v, [&](HalfedgeId h) { cavity_.add(mesh_.face(h)); });
  }
  return cavity_.size() > before;
}

bool TopologicalCleanup::remeshCavity(VertexId seed) {
  if (!mesh_.alive(seed)) return false;
  cavity_.clear();
  grow({seed});
  const int off = excess(seed);
  if (allQuads(mesh_, cavity_.faces()) && (mesh_.isBoundary(seed) ? off >= 0 : off == 0)) return false;
  while (cavity_.size() <= kLargestCavity) {
    const auto loop = cavity_.boundaryLoop(mesh_);
    if (!loop) return false;
    const std::vector<int> wanted = wantedInside(*loop);
    std::vector<VertexId> blocking;
    std::vector<VertexId> all;
    std::vector<int> corners;
    for (std::size_t i = 0; i < loop->size(); ++i) {
      all.push_back(mesh_.origin((*loop)[i]));
      if (wanted[i] == 1) corners.push_back(static_cast<int>(i));
      if (wanted[i] < 1 || wanted[i] > 2) blocking.push_back(all.back());
    }
    if (!blocking.empty()) {
      if (!grow(blocking)) return false;
      continue;
    }
    if (triedCavities_.insert(cavity_.signature()).second && fillCavity(*loop, corners)) return true;
    if (!grow(all)) return false;
  }
  return false;
}

bool TopologicalCleanup::fillCavity(const std::vector<HalfedgeId>& loop, const std::vector<int>& corners) {
  const std::vector<FaceId>& cavity = cavity_.faces();
  int energy = 0;
  for (const VertexId v : cavity_.vertices(mesh_)) energy += irregularity(mesh_.isBoundary(v), excess(v));
  const std::size_t triangles = triangleCount(mesh_, cavity);
  energy += kTriangleEnergy * static_cast<int>(triangles);
  if (triangles % 2 != 0 || energy <= (corners.size() == 4 ? 0 : 1)) return false;
  const double count = static_cast<double>(cavity.size()) - 0.5 * static_cast<double>(triangles);
  const auto fits = [count](std::size_t cells) {
    return std::fabs(static_cast<double>(cells) - count) <= kCountChange * count + 1.0;
  };
  std::vector<Vec3> outline;
  for (const HalfedgeId h : loop) outline.push_back(mesh_.position(mesh_.origin(h)));
  if (const auto pattern = fillSides(outline, corners)) {
    const int drop = energy - (corners.size() == 4 ? 0 : 1);
    return fits(pattern->cells.size()) && fillWith(*pattern, loop, measureCavity(triangles, count), drop);
  }
  if (energy <= kTwoEnergy) return false;
  std::optional<Measures> before;
  for (const SideCut& cut : cutsInTwo(outline, corners, kMostTries)) {
    if (!fits(static_cast<std::size_t>(cut.cells))) continue;
    if (!before) before = measureCavity(triangles, count);
    if (fillWith(fillCut(outline, corners, cut), loop, *before, energy - kTwoEnergy)) return true;
  }
  return false;
}

TopologicalCleanup::Measures TopologicalCleanup::measureCavity(std::size_t triangles, double count) const {
  const Shapes shapes = shapesOf(mesh_, cavity_.faces());
  Measures measures;
  measures.triangles = triangles;
  measures.count = count;
  measures.least = std::min(triangles > 0 ? options_.leastShape : kGoodShape, shapes.worst);
  measures.meanShape = shapes.mean;
  measures.stretch = stretchOf(mesh_, cavity_.faces());
  measures.distortion = distortionOf(mesh_, cavity_.faces(), wantedAreas(mesh_, cavity_.faces(), target_));
  return measures;
}

/// The inner vertices of a pattern for the cavity, on the patch.
std::vector<EditMesh::Vertex> TopologicalCleanup::innerVertices(const SidePattern& pattern,
                                                                const RelaxationTarget& rough) const {
  // The old inner vertices are good places to project from.
  const std::vector<VertexId> old = cornersOf(mesh_, cavity_.faces());
  std::vector<Vec3> places;
  places.reserve(old.size());
  for (const VertexId v : old) places.push_back(mesh_.position(v));
  std::vector<EditMesh::Vertex> inner;
  inner.reserve(pattern.inner.size());
  for (const Vec3& p : pattern.inner) {
    std::size_t nearest = 0;
    double least = squaredNorm(places[0] - p);
    for (std::size_t i = 1; i < places.size(); ++i) {
      const double square = squaredNorm(places[i] - p);
      if (!(square < least)) continue;
      least = square;
      nearest = i;
    }
    inner.push_back(projectVertex(rough, mesh_.vertex(old[nearest]), p));
  }
  return inner;
}

/// Relaxes a cavity that was filled anew. Returns whether its elements are less distorted than allowed in the end.
bool TopologicalCleanup::settleFilled(const std::vector<FaceId>& filled, const std::vector<VertexId>& moving,
                                      const RelaxationTarget& rough, double allowed) {
  // The vertices move, but not so far that much else is wanted of them.
  const std::vector<double> areas = wantedAreas(mesh_, filled, target_);
  double distortion = distortionOf(mesh_, filled, areas);
  for (int sweep = 0; sweep < kSettleSweeps; ++sweep) {
    relax(mesh_, moving, sweep < kRoughSweeps ? rough : target_, kGoodShape);
    const double before = std::exchange(distortion, distortionOf(mesh_, filled, areas));
    if (!(foreseen(distortion, before, kSettleSweeps - 1 - sweep) <= allowed)) return false;
  }
  return true;
}

bool TopologicalCleanup::fillWith(const SidePattern& pattern, const std::vector<HalfedgeId>& loop,
                                  const Measures& before, int drop) {
  const std::vector<FaceId>& cavity = cavity_.faces();
  std::vector<Vec3> outline;
  for (const HalfedgeId h : loop) outline.push_back(mesh_.position(mesh_.origin(h)));
  const Promise promise = promiseOf(pattern, std::move(outline));
  // Written such that a NaN is no promise.
  if (!(promise.stretch <= before.stretch + kPromisedStretch * drop)) return false;
  if (!(promise.meanShape >= before.meanShape - kPromisedLoss)) return false;
  if (cavity_.doublesEdge(mesh_, loop, pattern.cells)) return false;
  const double area = areaOf(mesh_, cavity);
  const std::vector<Vec3> centres = centresOf(mesh_, cavity);
  RelaxationTarget rough = target_;
  rough.onPatch = true;
  const std::vector<EditMesh::Vertex> inner = innerVertices(pattern, rough);
  const std::size_t mark = mesh_.mark();
  const std::vector<FaceId> filled = mesh_.fill(loop, cavity, pattern.cells, inner);
  const std::vector<VertexId> moving = cornersOf(mesh_, filled);
  const auto isGood = [&] {
    if (!settleFilled(filled, moving, rough, before.distortion + kDistortionWorth * drop)) return false;
    const Shapes after = shapesOf(mesh_, filled);
    const double worth = before.triangles > 0 ? kNoTriangleWorth : kRegularityWorth;
    if (after.worst < before.least || after.mean < before.meanShape - worth) return false;
    if (areaOf(mesh_, filled) < kAreaKept * area) return false;
    const double distance = distanceOf(centresOf(mesh_, filled), target_.face);
    return distance <= kNear * std::sqrt(area / before.count) || distance <= 1.5 * distanceOf(centres, target_.face);
  };
  if (isGood()) {
    touched_.insert(touched_.end(), moving.begin(), moving.end());
    mesh_.commit();
    ++statistics_.cavities;
    return true;
  }
  mesh_.rollback(mark);
  return false;
}

}  // namespace qmcf
