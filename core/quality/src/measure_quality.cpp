#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "fidelity.hpp"
#include "ledger.hpp"
#include "qmcf/base/math.hpp"
#include "reference_checks.hpp"
#include "structural_checks.hpp"

namespace qmcf {
namespace quality {
namespace {

/// A place of the part so many target lengths away from the mesh is missed by it.
constexpr double kMissed = 1.5;

/// Values of one metric, summarised with the worst at one end.
class Sample {
 public:
  explicit Sample(bool largerIsWorse) : sign_(largerIsWorse ? -1.0 : 1.0) {}

  void add(double value) {
    if (std::isfinite(value)) {
      // Ascending order of the signed values is from worst to best.
      values_.push_back(sign_ * value);
    } else {
      ++infinite_;
    }
  }

  [[nodiscard]] Distribution summary() && {
    Distribution result;
    result.infinite = infinite_;
    if (values_.empty()) return result;
    result.mean = sign_ * std::accumulate(values_.begin(), values_.end(), 0.0) / static_cast<double>(values_.size());
    std::sort(values_.begin(), values_.end());
    result.worst = sign_ * values_.front();
    result.p1 = sign_ * quantile(0.01);
    result.median = sign_ * quantile(0.5);
    return result;
  }

 private:
  [[nodiscard]] double quantile(double share) const {
    const double place = share * static_cast<double>(values_.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values_.size() - 1);
    return values_[below] + (place - static_cast<double>(below)) * (values_[above] - values_[below]);
  }

  double sign_;
  std::vector<double> values_;
  std::int64_t infinite_ = 0;
};

/// Centres and areas; 0 for unusable elements. A quadrilateral's surface is the fan around its centre.
void measureElements(const QuadMesh& mesh, const std::vector<std::uint8_t>& usable, std::vector<Vec3>& centres,
                     std::vector<double>& areas) {
  centres.assign(mesh.elements.size(), Vec3{});
  areas.assign(mesh.elements.size(), 0.0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (usable[e] == 0) continue;
    const Element& element = mesh.elements[e];
    const std::size_t corners = cornerCount(element);
    const auto at = [&](std::size_t corner) -> const Vec3& {
      return mesh.positions[static_cast<std::size_t>(element[corner % corners])];
    };
    Vec3 sum;
    for (std::size_t c = 0; c < corners; ++c) sum += at(c);
    centres[e] = sum / static_cast<double>(corners);
    if (corners == 3) {
      areas[e] = 0.5 * norm(cross(at(1) - at(0), at(2) - at(0)));
      continue;
    }
    for (std::size_t c = 0; c < corners; ++c) {
      areas[e] += 0.5 * norm(cross(at(c) - centres[e], at(c + 1) - centres[e]));
    }
  }
}

void measureShape(const MeasuredMesh& measured, QualityReport& report) {
  struct Column {
    double QuadMetrics::*metric;
    Distribution QualityReport::*figure;
    Sample sample;
  };
  std::vector<Column> columns{
      {&QuadMetrics::scaledJacobian, &QualityReport::scaledJacobian, Sample(false)},
      {&QuadMetrics::jacobianRatio, &QualityReport::jacobianRatio, Sample(true)},
      {&QuadMetrics::jacobianRatioGauss, &QualityReport::jacobianRatioGauss, Sample(true)},
      {&QuadMetrics::aspectRatio, &QualityReport::aspectRatio, Sample(true)},
      {&QuadMetrics::edgeRatio, &QualityReport::edgeRatio, Sample(true)},
      {&QuadMetrics::orthogonalQuality, &QualityReport::orthogonalQuality, Sample(false)},
      {&QuadMetrics::minAngle, &QualityReport::minAngle, Sample(false)},
      {&QuadMetrics::maxAngle, &QualityReport::maxAngle, Sample(true)},
      {&QuadMetrics::skewness, &QualityReport::skewness, Sample(true)},
      {&QuadMetrics::warpage, &QualityReport::warpage, Sample(true)},
  };
  Sample triangles(false);
  for (std::size_t e = 0; e < measured.mesh.elements.size(); ++e) {
    if (measured.usable[e] == 0) continue;
    const Element& element = measured.mesh.elements[e];
    const auto at = [&](std::size_t corner) -> const Vec3& {
      return measured.mesh.positions[static_cast<std::size_t>(element[corner])];
    };
    if (cornerCount(element) == 3) {
      ++report.triangles;
      triangles.add(triangleScaledJacobian(at(0), at(1), at(2)));
      continue;
    }
    ++report.quads;
    const QuadMetrics metrics = quadMetrics(at(0), at(1), at(2), at(3));
    for (Column& column : columns) column.sample.add(metrics.*column.metric);
  }
  for (Column& column : columns) report.*column.figure = std::move(column.sample).summary();
  report.triangleScaledJacobian = std::move(triangles).summary();
  const std::int64_t elements = report.quads + report.triangles;
  report.quadShare = elements > 0 ? static_cast<double>(report.quads) / static_cast<double>(elements) : 0.0;
}

void measureRegularity(const MeasuredMesh& measured, QualityReport& report) {
  const Structure& structure = measured.structure;
  std::vector<std::uint8_t> hasTriangle(measured.mesh.positions.size(), 0);
  for (std::size_t e = 0; e < measured.mesh.elements.size(); ++e) {
    const Element& element = measured.mesh.elements[e];
    if (measured.usable[e] == 0 || cornerCount(element) == 4) continue;
    for (std::size_t c = 0; c < 3; ++c) hasTriangle[static_cast<std::size_t>(element[c])] = 1;
  }
  for (std::size_t v = 0; v < structure.fans.size(); ++v) {
    if (structure.fans[v] != 1 || structure.onBoundary[v] != 0 || structure.onNonManifold[v] != 0) continue;
    ++report.interiorVertices;
    if (structure.elementsAround[v] != 4 || hasTriangle[v] != 0) ++report.irregularVertices;
    if (structure.elementsAround[v] == 2) ++report.doublets;
  }
  if (report.interiorVertices > 0) {
    report.regularShare =
        1.0 - static_cast<double>(report.irregularVertices) / static_cast<double>(report.interiorVertices);
  }
}

/// The side of the mean quad; of the mean equilateral triangle when there is no quad.
double meanSize(const MeasuredMesh& measured) {
  double quadArea = 0.0;
  double triangleArea = 0.0;
  std::int64_t quads = 0;
  std::int64_t triangles = 0;
  for (std::size_t e = 0; e < measured.mesh.elements.size(); ++e) {
    if (measured.usable[e] == 0) continue;
    const bool isQuad = cornerCount(measured.mesh.elements[e]) == 4;
    (isQuad ? quadArea : triangleArea) += measured.areas[e];
    ++(isQuad ? quads : triangles);
  }
  if (quads > 0) return std::sqrt(quadArea / static_cast<double>(quads));
  if (triangles > 0) return std::sqrt(4.0 / std::sqrt(3.0) * triangleArea / static_cast<double>(triangles));
  return 0.0;
}

double meanSizeError(const MeasuredMesh& measured, double size) {
  double sum = 0.0;
  std::int64_t count = 0;
  for (const EdgeRecord& edge : measured.structure.edges.edges) {
    const double length = distance(measured.mesh.positions[static_cast<std::size_t>(edge.low)],
                                   measured.mesh.positions[static_cast<std::size_t>(edge.high)]);
    if (!(length > 0.0)) continue;
    sum += std::fabs(math::log2(length / size));
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

void measureTopology(const MeasuredMesh& measured, QualityReport& report) {
  const Structure& structure = measured.structure;
  report.vertices = static_cast<std::int64_t>(measured.mesh.positions.size());
  report.components = structure.components;
  report.eulerCharacteristic = structure.eulerCharacteristic;
  report.boundaryEdges = std::count_if(structure.edges.edges.begin(), structure.edges.edges.end(),
                                       [](const EdgeRecord& edge) { return edge.useCount == 1; });
}

void measureFidelity(const MeasuredMesh& measured, const Reference& reference,
                     const std::vector<ClosestPoint>& projected, double featureAngle, QualityReport& report) {
  const double far = report.size > 0.0 ? kMissed * report.size : std::numeric_limits<double>::infinity();
  Distances distances = measureDistances(measured, reference, projected, far);
  report.meanDistance = distances.mean;
  report.largestDistance = distances.largest;
  report.largestGap = distances.largestGap;
  report.missed = std::move(distances.missed);
  if (!(report.size > 0.0)) return;
  const Recall recall = measureRecall(measured, findFeatures(reference, featureAngle), report.size);
  report.sharpRecall = recall.sharp;
  report.boundaryRecall = recall.boundary;
  report.nonManifoldRecall = recall.nonManifold;
  report.cornerRecall = recall.corner;
}

}  // namespace
}  // namespace quality

QualityReport measureQuality(const QuadMesh& mesh, const TriangleMesh* reference, const QualityOptions& options) {
  using namespace quality;
  const Screening screening = screenElements(mesh.positions, mesh.elements);
  const Structure structure = buildStructure(mesh.positions, mesh.elements, screening.usable);
  std::vector<Vec3> centres;
  std::vector<double> areas;
  measureElements(mesh, screening.usable, centres, areas);
  const MeasuredMesh measured{mesh, screening.usable, structure, centres, areas};

  QualityReport report;
  measureTopology(measured, report);
  report.ledger = balance(mesh.elements, screening.usable, structure.edges);
  measureShape(measured, report);
  measureRegularity(measured, report);
  report.area = std::accumulate(areas.begin(), areas.end(), 0.0);
  report.size = options.size.value_or(meanSize(measured));
  if (report.size > 0.0) report.sizeError = meanSizeError(measured, report.size);

  CheckList checks;
  addElementChecks(mesh, screening, checks);
  addSegmentCheck(mesh, structure, checks);
  if (reference == nullptr) {
    addManifoldChecks(mesh, structure, checks);
  } else {
    const Reference welded = buildReference(*reference);
    std::vector<ClosestPoint> projected;
    if (!welded.bvh.empty() && report.quads + report.triangles > 0) {
      projected = projectCentres(measured, welded);
      measureFidelity(measured, welded, projected, options.featureAngle, report);
    }
    report.ledger.partFourEuler = fourEulerOf(welded);
    addReferenceChecks(measured, welded, report, projected, checks);
  }
  ValidityReport validity = std::move(checks).report();
  report.checks = std::move(validity.checks);
  report.valid = validity.valid;
  return report;
}

}  // namespace qmcf
