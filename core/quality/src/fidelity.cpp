#include "fidelity.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "qmcf/quality/turned_over.hpp"

namespace qmcf::quality {
namespace {

constexpr std::size_t kGapSamples = 2000;  ///< Vertices and triangles of the reference that are looked at, at most.

/// The mesh as triangles: quadrilaterals become the fan around their centre.
TriangleBvh treeOf(const MeasuredMesh& measured) {
  std::vector<Vec3> positions = measured.mesh.positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
  triangles.reserve(measured.mesh.elements.size() * 4);
  for (std::size_t e = 0; e < measured.mesh.elements.size(); ++e) {
    if (measured.usable[e] == 0) continue;
    const Element& element = measured.mesh.elements[e];
    if (cornerCount(element) == 3) {
      triangles.push_back({element[0], element[1], element[2]});
      continue;
    }
    const auto centre = static_cast<std::int32_t>(positions.size());
    positions.push_back(measured.centres[e]);
    for (std::size_t c = 0; c < 4; ++c) triangles.push_back({element[c], element[(c + 1) % 4], centre});
  }
  return {positions, triangles};
}

double distanceTo(const TriangleBvh& tree, const Vec3& point, std::int32_t hint = -1) {
  return std::sqrt(tree.closest(point, hint).squaredDistance);
}

/// Per vertex of the mesh, the triangle of the part below one of its elements.
std::vector<std::int32_t> trianglesBelow(const MeasuredMesh& measured, const std::vector<ClosestPoint>& projected) {
  std::vector<std::int32_t> below(measured.mesh.positions.size(), -1);
  for (std::size_t e = 0; e < measured.mesh.elements.size(); ++e) {
    if (measured.usable[e] == 0) continue;
    const Element& element = measured.mesh.elements[e];
    for (std::size_t c = 0; c < cornerCount(element); ++c) {
      below[static_cast<std::size_t>(element[c])] = projected[e].triangle;
    }
  }
  return below;
}

void measureGaps(Distances& result, const MeasuredMesh& measured, const Reference& reference, double far) {
  const TriangleBvh tree = treeOf(measured);
  if (tree.empty()) return;
  const auto look = [&](const Vec3& place) {
    const double gap = distanceTo(tree, place);
    result.largestGap = std::max(result.largestGap, gap);
    if (gap > far) result.missed.push_back(place);
  };
  const std::size_t vertexStep = (reference.positions.size() + kGapSamples - 1) / kGapSamples;
  for (std::size_t v = 0; v < reference.positions.size(); v += vertexStep) {
    look(reference.positions[v]);
  }
  const std::size_t triangleStep = (reference.triangles.size() + kGapSamples - 1) / kGapSamples;
  for (std::size_t t = 0; t < reference.triangles.size(); t += triangleStep) {
    Vec3 sum;
    for (std::size_t c = 0; c < 3; ++c) sum += reference.positions[static_cast<std::size_t>(reference.triangles[t][c])];
    look(sum / 3.0);
  }
}

}  // namespace

std::vector<ClosestPoint> projectCentres(const MeasuredMesh& measured, const Reference& reference) {
  std::vector<ClosestPoint> result(measured.mesh.elements.size());
  std::int32_t last = -1;  // Elements that follow each other tend to be neighbours.
  for (std::size_t e = 0; e < result.size(); ++e) {
    if (measured.usable[e] == 0) continue;
    result[e] = reference.bvh.closest(measured.centres[e], last);
    last = result[e].triangle;
  }
  return result;
}

Distances measureDistances(const MeasuredMesh& measured, const Reference& reference,
                           const std::vector<ClosestPoint>& projected, double far) {
  Distances result;
  const std::vector<std::int32_t> below = trianglesBelow(measured, projected);
  for (std::size_t v = 0; v < measured.mesh.positions.size(); ++v) {
    if (measured.structure.elementsAround[v] == 0) continue;
    result.largest = std::max(result.largest, distanceTo(reference.bvh, measured.mesh.positions[v], below[v]));
  }
  double area = 0.0;
  for (std::size_t e = 0; e < measured.mesh.elements.size(); ++e) {
    if (measured.usable[e] == 0) continue;
    const double d = std::sqrt(projected[e].squaredDistance);
    result.largest = std::max(result.largest, d);
    result.mean += d * measured.areas[e];
    area += measured.areas[e];
  }
  if (area > 0.0) result.mean /= area;
  measureGaps(result, measured, reference, far);
  return result;
}

std::vector<std::int64_t> findTurnedOver(const MeasuredMesh& measured, const Reference& reference,
                                         const std::vector<ClosestPoint>& projected) {
  std::vector<std::int64_t> result;
  for (std::size_t e = 0; e < measured.mesh.elements.size(); ++e) {
    if (measured.usable[e] == 0) continue;
    const Element& element = measured.mesh.elements[e];
    const std::size_t count = cornerCount(element);
    std::array<Vec3, 4> corners;
    for (std::size_t c = 0; c < count; ++c) corners[c] = measured.mesh.positions[static_cast<std::size_t>(element[c])];
    if (turnedOverBy(reference.bvh, corners, count, projected[e]) > 0.0) result.push_back(static_cast<std::int64_t>(e));
  }
  return result;
}

}  // namespace qmcf::quality
