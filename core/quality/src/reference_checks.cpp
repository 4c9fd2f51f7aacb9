#include "reference_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "ledger.hpp"
#include "structural_checks.hpp"

namespace qmcf::quality {
namespace {

constexpr double kNonManifoldExcess = 1.1;  ///< Of the reference's length of non-manifold edges.
constexpr double kBoundaryTolerance = 0.1;  ///< Of the reference's boundary length.
constexpr double kShortBoundary = 4.0;      ///< Sizes; a shorter boundary may vanish in the mesh.
constexpr double kCoverageLeast = 0.8;      ///< Area ratios beyond which the mesh fails ...
constexpr double kCoverageMost = 1.25;
constexpr double kCoverageTolerance = 0.05;  ///< ... and beyond which it is warned about.

std::string percent(double ratio) { return std::to_string(static_cast<int>(std::floor(100.0 * ratio + 0.5))) + " %"; }

/// The defects themselves if there are more of them than the reference has, else none.
std::vector<std::int64_t> beyond(std::vector<std::int64_t> defects, std::size_t allowed) {
  if (defects.size() <= allowed) defects.clear();
  return defects;
}

void addManifold(const MeasuredMesh& measured, const Reference& reference, CheckList& checks) {
  const Structure& structure = measured.structure;
  const bool excess = structure.nonManifoldLength > kNonManifoldExcess * reference.structure.nonManifoldLength;
  checks.add("nonManifoldEdges", CheckStatus::fail, excess ? nonManifoldEdges(structure) : std::vector<std::int64_t>{},
             "edges have more than two elements, more than the part itself has (one element of each listed)");
  checks.add("nonManifoldVertices", CheckStatus::fail,
             beyond(pinchedVertices(structure), pinchedVertices(reference.structure).size()),
             "vertices join elements that share no edge there, more than the part itself has (vertices listed)");
  const std::vector<std::int64_t> conflicts = orientationConflicts(structure);
  if (!conflicts.empty() && !reference.oriented) {
    checks.skip("orientationConflicts", "The part is not consistently oriented itself.");
  } else {
    checks.add("orientationConflicts", CheckStatus::fail, conflicts,
               "edges lie between elements that face opposite sides (one element of each listed)");
  }
}

std::vector<std::int64_t> boundaryElements(const Structure& structure) {
  std::vector<std::int64_t> result;
  for (const EdgeRecord& edge : structure.edges.edges) {
    if (edge.useCount == 1) result.push_back(structure.edges.usesOf(edge)[0].element);
  }
  return result;
}

void addBoundary(const MeasuredMesh& measured, const Reference& reference, double size, CheckList& checks) {
  const Structure& structure = measured.structure;
  if (reference.isClosed()) {
    checks.add("boundary", CheckStatus::fail, boundaryElements(structure),
               "edges have one element only although the part is closed (elements listed)");
    return;
  }
  const double ratio = structure.boundaryLength / reference.structure.boundaryLength;
  const bool agrees = std::fabs(ratio - 1.0) <= kBoundaryTolerance;
  const bool undecided = reference.structure.boundaryLength < kShortBoundary * size || reference.seams.any;
  checks.addCount("boundary", undecided ? CheckStatus::warn : CheckStatus::fail, agrees ? 0 : 1,
                  "The mesh's boundary is " + percent(ratio) + " as long as the part's.");
}

void addSeams(const MeasuredMesh& measured, const Reference& reference, CheckList& checks) {
  const Seams seams = findSeams(measured.mesh.positions, measured.structure, reference.diagonal);
  checks.add("cracks", CheckStatus::fail, beyond(seams.cracks, reference.seams.cracks.size()),
             "boundary vertices lie at the same place as another one (vertices listed)");
  checks.add("tJunctions", CheckStatus::fail, beyond(seams.tJunctions, reference.seams.tJunctions.size()),
             "boundary vertices lie inside a boundary edge of other elements (vertices listed)");
}

void addLedger(const IndexLedger& ledger, CheckList& checks) {
  if (!ledger.partFourEuler) {
    checks.skip("indexLedger", "The part has non-manifold edges or pieces that don't quite meet.");
    return;
  }
  checks.addCount("indexLedger", CheckStatus::fail, ledger.closes() ? 0 : 1,
                  "Irregular vertices, boundary and triangles are worth " + std::to_string(ledger.sum()) +
                      " quarter turns in all, not the part's " + std::to_string(*ledger.partFourEuler) + ".");
}

void addTopology(const MeasuredMesh& measured, const Reference& reference, CheckList& checks) {
  const bool clean = reference.structure.nonManifoldLength == 0.0 && pinchedVertices(reference.structure).empty() &&
                     !reference.seams.any;
  const CheckStatus status = clean ? CheckStatus::fail : CheckStatus::warn;
  const auto compare = [&](std::string_view name, std::string_view what, std::int64_t mesh, std::int64_t part) {
    checks.addCount(
        name, status, std::abs(mesh - part),
        "The mesh has " + std::string(what) + " " + std::to_string(mesh) + ", the part " + std::to_string(part) + ".");
  };
  compare("components", "a number of components of", measured.structure.components, reference.structure.components);
  compare("euler", "an Euler characteristic of", measured.structure.eulerCharacteristic,
          reference.structure.eulerCharacteristic);
}

void addCoverage(const MeasuredMesh& measured, const Reference& reference, CheckList& checks) {
  const double area = std::accumulate(measured.areas.begin(), measured.areas.end(), 0.0);
  const double ratio = reference.area > 0.0 ? area / reference.area : 0.0;
  const bool covers = ratio >= kCoverageLeast && ratio <= kCoverageMost;
  const bool close = std::fabs(ratio - 1.0) <= kCoverageTolerance;
  checks.addCount("coverage", covers ? CheckStatus::warn : CheckStatus::fail, close ? 0 : 1,
                  "The mesh has " + percent(ratio) + " of the part's area.");
}

}  // namespace

std::optional<std::int64_t> fourEulerOf(const Reference& reference) {
  if (reference.structure.nonManifoldLength > 0.0 || reference.seams.any) return std::nullopt;
  const std::vector<std::uint8_t> all(reference.triangles.size(), 1);
  return balance(reference.triangles, all, reference.structure.edges).fourEuler;
}

void addReferenceChecks(const MeasuredMesh& measured, const Reference& reference, const QualityReport& report,
                        const std::vector<ClosestPoint>& projected, CheckList& checks) {
  addManifold(measured, reference, checks);
  addBoundary(measured, reference, report.size, checks);
  addSeams(measured, reference, checks);
  addTopology(measured, reference, checks);
  addLedger(report.ledger, checks);
  addCoverage(measured, reference, checks);
  if (!reference.oriented) {
    checks.skip("facesTurnedOver", "The part is not consistently oriented itself.");
  } else if (reference.bvh.empty()) {
    checks.skip("facesTurnedOver", "The part has no triangle with a normal.");
  } else {
    checks.add("facesTurnedOver", CheckStatus::fail, findTurnedOver(measured, reference, projected),
               "elements face against the part's surface (elements listed)");
  }
}

}  // namespace qmcf::quality
