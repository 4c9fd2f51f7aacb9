#include "part.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace qmcf {
namespace {

/// Coordinates relative to the smallest ones, in steps of a power of two of about 1 / 100,000 of the part.
TraceScale traceScale(const TriangleMesh& mesh) {
  constexpr double kSteps = 131072.0;
  Vec3 low = mesh.positions.front();
  Vec3 high = low;
  for (const Vec3& p : mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  int exponent = 0;
  static_cast<void>(std::frexp(distance(low, high) / kSteps, &exponent));
  return {low, std::ldexp(1.0, exponent)};
}

}  // namespace

Part::Part(const TriangleMesh& partMesh, const Brep& partBrep, const RunOptions& meshOptions)
    : mesh(partMesh), brep(partBrep), options(meshOptions) {
  if (options.trace) traceScale = qmcf::traceScale(mesh);
  for (const BrepFace& face : brep.faces) {
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (const std::int32_t t : face.triangles) triangles.push_back(mesh.triangles[static_cast<std::size_t>(t)]);
    faceTrees.emplace_back(mesh.positions, triangles);
  }
}

}  // namespace qmcf
