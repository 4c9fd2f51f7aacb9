#include "settled_face.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "qmcf/field/natural_size.hpp"
#include "qmcf/quality/quality.hpp"
#include "settle_sizes.hpp"

namespace qmcf {
namespace {

/// Meshes of more elements than this are off their sizes by half as much, and would take a third longer.
constexpr double kManyElements = 10'000.0;
/// The edges of a mesh that is near enough to its sizes are off by less than this, on the mean, in logarithms.
constexpr double kNear = 0.03;
/// How much irregularity the second mesh may have more than the first.
constexpr double kMoreIrregular = 1.1;
constexpr double kPair = 2.0;

/// How far the edges of a mesh are off the sizes of its patch, on the mean: |log(length / size)|.
double deviationOf(const Patch& patch, const FaceMesh& mesh) {
  const std::vector<SizedEdge> edges = sizedEdges(patch, mesh);
  double sum = 0.0;
  for (const SizedEdge& edge : edges) sum += std::fabs(edge.log);
  return edges.empty() ? 0.0 : sum / static_cast<double>(edges.size());
}

/// The sum of (elements - 4)^2 over the vertices inside, and 4 for each triangle.
double irregularityOf(const FaceMesh& mesh) {
  const IndexLedger ledger = indexLedger(mesh.positions, mesh.elements);
  double sum = 4.0 * static_cast<double>(ledger.triangles);
  for (const LedgerEntry& entry : ledger.interior) {
    const double excess = static_cast<double>(entry.elements) - 4.0;
    sum += excess * excess * static_cast<double>(entry.vertices);
  }
  return sum;
}

bool isByFront(const MeshedFace& face) { return face.report.method == modeName(Mode::qmcf); }

}  // namespace

bool settlesWithMeshes(const Part& part, const PreparedFaces& prepared) {
  if (part.options.mode != Mode::qmcf || settlingOf(part.options) != Settling::turned) return false;
  double elements = 0.0;
  for (const Patch& patch : prepared.patches) elements += expectedElements(patch);
  return elements <= kManyElements;
}

Result<MeshedFace> meshSettled(const Part& part, PreparedFaces& prepared, std::int32_t face, Progress& progress) {
  auto first = meshFace(part, prepared, face, progress);
  if (!first || !isByFront(first.value())) return first;
  const auto f = static_cast<std::size_t>(face);
  const Patch& patch = prepared.patches[f];
  const FaceMesh& before = first.value().mesh;
  const double deviation = deviationOf(patch, before);
  if (deviation < kNear) return first;

  IdMap<VertexId, double> sizes = patch.size;
  const std::uint8_t settled = prepared.settled[f];
  if (const auto error = followMesh(prepared, f, before, part.options, progress)) {
    if (error->code == ErrorCode::cancelled) return *error;
    return first;
  }
  auto second = meshFace(part, prepared, face, progress);
  if (!second) return second;
  const FaceMesh& now = second.value().mesh;
  const bool isBetter = isByFront(second.value()) && deviationOf(patch, now) < deviation &&
                        second.value().report.triangles <= first.value().report.triangles &&
                        irregularityOf(now) <= kMoreIrregular * irregularityOf(before) + kPair;
  if (isBetter) {
    prepared.sizesBefore[f] = std::move(sizes);
    return second;
  }
  prepared.patches[f].size = std::move(sizes);
  prepared.settled[f] = settled;
  return first;
}

}  // namespace qmcf
