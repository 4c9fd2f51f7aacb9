#include "matrices.hpp"

#include <algorithm>
#include <vector>

namespace qmcf {
namespace {

/// Weights below this break the maximum principle and let crosses flip for no reason.
constexpr double kSmallestWeight = 0.02;
constexpr double kLargestWeight = 50.0;

using Triplet = Eigen::Triplet<Complex>;

int row(VertexId v) { return static_cast<int>(v.value); }

/// Half the cotangent of the angle opposite to h; 0 in a degenerate triangle.
double halfCotangent(const Surface& surface, HalfedgeId h) {
  const Vec3 apex = surface.position(surface.opposite(h));
  const Vec3 a = surface.position(surface.origin(h)) - apex;
  const Vec3 b = surface.position(surface.target(h)) - apex;
  const double twiceArea = norm(cross(a, b));
  return twiceArea > 1e-14 * (norm(a) * norm(b)) ? 0.5 * dot(a, b) / twiceArea : 0.0;
}

}  // namespace

FieldMatrices measuredMatrices(const Patch& patch) {
  const Surface& surface = patch.surface;
  const auto count = static_cast<Eigen::Index>(surface.vertexCount());
  FieldMatrices matrices;
  matrices.area = Eigen::VectorXd::Zero(count);
  double total = 0.0;
  for (const TriangleId t : surface.triangles()) {
    const double third = norm(surface.areaVector(t)) / 6.0;
    for (const VertexId v : surface.corners(t)) matrices.area[row(v)] += third;
    total += 3.0 * third;
  }
  // A vertex without area would leave its cross without a say in the diffusion.
  const double least = 1e-6 * std::max(total, 1e-300) / static_cast<double>(count);
  matrices.area = matrices.area.cwiseMax(least);
  matrices.cells = matrices.area;
  for (const VertexId v : surface.vertices()) matrices.cells[row(v)] /= patch.size[v] * patch.size[v];
  return matrices;
}

FieldMatrices assembleCotangent(const Patch& patch, const Connection& connection) {
  const Surface& surface = patch.surface;
  const auto count = static_cast<Eigen::Index>(surface.vertexCount());
  FieldMatrices matrices = measuredMatrices(patch);
  std::vector<double> diagonal(surface.vertexCount(), 0.0);
  std::vector<Triplet> entries;
  entries.reserve(surface.halfedgeCount() + 2 * surface.vertexCount());
  for (const HalfedgeId h : surface.halfedges()) {
    const HalfedgeId back = surface.twin(h);
    if (back.valid() && back < h) continue;
    double weight = halfCotangent(surface, h);
    if (back.valid()) weight += halfCotangent(surface, back);
    weight = std::clamp(weight, kSmallestWeight, kLargestWeight);
    const Complex move = transportCross(surface, connection, h);
    const int from = row(surface.origin(h));
    const int to = row(surface.target(h));
    diagonal[surface.origin(h).index()] += weight;
    diagonal[surface.target(h).index()] += weight;
    entries.emplace_back(to, from, -weight * move);
    entries.emplace_back(from, to, -weight * std::conj(move));
  }
  for (const VertexId v : surface.vertices()) entries.emplace_back(row(v), row(v), diagonal[v.index()]);
  matrices.energy.resize(count, count);
  matrices.energy.setFromTriplets(entries.begin(), entries.end());
  matrices.mass = FieldMatrix(matrices.area.cast<Complex>().asDiagonal());
  return matrices;
}

}  // namespace qmcf
