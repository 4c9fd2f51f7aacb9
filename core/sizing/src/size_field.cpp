#include "qmcf/sizing/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "edge_samples.hpp"
#include "inner_sources.hpp"
#include "mesh_gradation.hpp"
#include "qmcf/base/math.hpp"
#include "sample_graph.hpp"

namespace qmcf {
namespace {

// In units of the base size: how small the edges themselves may make an element.
constexpr double kLowestByTurning = 0.1;
constexpr double kLowestByLength = 0.3;
constexpr double kSampleSpacing = 0.5;
// The base size that makes the number of quads come out right is found by trying.
constexpr int kAttempts = 6;
constexpr double kCountTolerance = 0.02;
// Larger elements make up for small ones at edges up to here, and for those that curvature asks for.
constexpr double kReachByCount = 1.7;
constexpr double kReachByCurvature = 3.0;
// A gap of so many sizes takes one row of elements.
constexpr double kOneRow = 1.5;
// A smooth arc in the least number of divisions, and some room for corners of its polygon.
constexpr double kRoomForSagitta = 1.1;
constexpr std::int64_t kDefaultQuads = 3000;
constexpr std::int64_t kMostQuads = 10'000'000;

Error invalid(std::string message) { return {ErrorCode::invalidOption, std::move(message), {}}; }

Error tooFine() {
  return invalid(
      "Sizes and curvature would take more than 10,000,000 quads; choose larger sizes or a larger distance.");
}

/// The first option out of range.
std::optional<Error> checkOptions(const TriangleMesh& mesh, const SizingOptions& options) {
  const auto isLength = [](double x) { return x > 0.0 && std::isfinite(x); };
  if (!(options.gradation > 0.0) || options.gradation > 1.0) {
    return invalid("The gradation must be above 0 and at most 1.");
  }
  if (options.chordSize && !(*options.chordSize > 0.0)) return invalid("The chord size must be above 0.");
  if (options.divisionsPerTurn < 3) return invalid("A full turn needs at least 3 divisions.");
  if (options.size && options.quads) return invalid("Give either an element size or a number of quads, not both.");
  if (options.size && !isLength(*options.size)) return invalid("The element size must be above 0.");
  const std::int64_t quads = options.quads.value_or(kDefaultQuads);
  if (quads < 1 || quads > kMostQuads) return invalid("The number of quads must be between 1 and 10,000,000.");
  if (options.curvature && !isLength(*options.curvature)) return invalid("The distance of chords must be above 0.");
  if (options.vertexSize.empty()) return std::nullopt;
  if (options.quads) return invalid("Give either sizes at the vertices or a number of quads, not both.");
  if (options.vertexSize.size() != mesh.positions.size()) return invalid("Each vertex of the mesh needs one size.");
  if (!std::all_of(options.vertexSize.begin(), options.vertexSize.end(), isLength)) {
    return invalid("The sizes at the vertices must be above 0.");
  }
  return std::nullopt;
}

Result<double> baseSize(const TriangleMesh& mesh, const Brep& brep, const SizingOptions& options) {
  double area = 0.0;
  for (const BrepFace& face : brep.faces) area += face.area;
  if (!(area > 0.0)) return Error{ErrorCode::noSurface, "The part has no area to mesh.", {}};
  if (!options.size && options.vertexSize.empty()) {
    return std::sqrt(area / static_cast<double>(options.quads.value_or(kDefaultQuads)));
  }
  double base = options.size.value_or(0.0);
  if (!options.size) {
    std::vector<double> graded = options.vertexSize;
    MeshGradation(mesh.positions, mesh.triangles)
        .grade(graded, std::numeric_limits<double>::infinity(), options.gradation);
    base = *std::max_element(graded.begin(), graded.end());
  }
  if (area / base / base > static_cast<double>(kMostQuads)) {
    if (!options.size) return tooFine();
    return invalid("This element size would take more than 10,000,000 quads; choose a larger one.");
  }
  return base;
}

/// Distance of an arc from its chord, in units of the chord, where so many chords make a full turn.
double arcSagitta(std::int32_t divisionsPerTurn) {
  const double quarter = 0.5 * math::kPi / divisionsPerTurn;  // Of the angle that a chord spans.
  return 0.5 * math::sin(quarter) / math::cos(quarter);
}

/// Finds the base size for a count by secants: the count falls like a power of the size, with an exponent near 2 where
/// the size rules and a smaller one where curvature and gaps do. Sizes are taken relative to the first, so that a part
/// scaled by a power of two gets exactly the scaled size.
class CountSearch {
 public:
  explicit CountSearch(double first) : first_(first) {}

  /// The size to try next, given that `size` led to `ratio` times the wanted count.
  double next(double size, double ratio) {
    const double x = math::log(size / first_);
    const double y = math::log(ratio);
    if (tried_ && x != x_) exponent_ = std::clamp((y_ - y) / (x - x_), 0.4, 2.5);
    tried_ = true;
    x_ = x;
    y_ = y;
    return first_ * math::exp(x + y / exponent_);
  }

 private:
  double first_;
  double exponent_ = 2.0;
  bool tried_ = false;
  double x_ = 0.0;
  double y_ = 0.0;
};

/// Per edge: how many divisions its sizes ask for.
std::vector<double> divisionsOf(const EdgeSamples& samples, const std::vector<std::int32_t>& least) {
  std::vector<double> divisions;
  divisions.reserve(samples.sizes.size());
  for (std::size_t e = 0; e < samples.sizes.size(); ++e) {
    divisions.push_back(std::max(samples.sizes[e].divisions().back(), static_cast<double>(least[e])));
  }
  return divisions;
}

/// Lowers the sizes at the vertices of each face to the cones of the limits in it.
void applyLimits(std::vector<double>& value, const TriangleMesh& mesh, const Brep& brep,
                 const std::vector<SizeLimit>& limits, double gradation) {
  for (const SizeLimit& limit : limits) {
    for (const std::int32_t t : brep.faces[static_cast<std::size_t>(limit.face)].triangles) {
      for (const std::int32_t vertex : mesh.triangles[static_cast<std::size_t>(t)]) {
        const auto v = static_cast<std::size_t>(vertex);
        value[v] = std::min(value[v], limit.size + gradation * distance(limit.position, mesh.positions[v]));
      }
    }
  }
}

/// Sizes at the vertices of the mesh: those on edges and inside faces are given, then graded along the triangles'
/// edges.
std::vector<double> vertexSizes(const TriangleMesh& mesh, const Brep& brep, const EdgeSamples& samples,
                                const InnerSizes& inner, const std::vector<SizeLimit>& limits, double gradation) {
  std::vector<double> value(mesh.positions.size(), samples.base);
  if (!inner.empty()) std::copy_n(inner.value.begin(), value.size(), value.begin());
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const EdgeCurve& curve = samples.curves[e];
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      double& v = value[static_cast<std::size_t>(brep.edges[e].points[i])];
      v = std::min(v, interpolate(samples.sizes[e].arcLength, samples.sizes[e].value, curve.arcLength[i]));
    }
  }
  applyLimits(value, mesh, brep, limits, gradation);
  const bool isLevel = std::all_of(value.begin(), value.end(), [&](double size) { return size >= samples.base; });
  if (!isLevel) MeshGradation(mesh.positions, mesh.triangles).grade(value, samples.base, gradation);
  return value;
}

}  // namespace

Result<SizeField> computeSizeField(const TriangleMesh& mesh, const Brep& brep, const SizingOptions& options,
                                   Progress& progress) {
  if (std::optional<Error> error = checkOptions(mesh, options)) return *std::move(error);
  const Result<double> base = baseSize(mesh, brep, options);
  if (!base.ok()) return base.error();
  if (!progress.report(Stage::sizing, 0.0)) return cancelledError();

  const bool byCount = !options.size && options.vertexSize.empty();
  const double mean = options.scale != nullptr ? options.scale->mean() : 1.0;
  const double first = byCount ? base.value() / mean : base.value();
  EdgeSamples samples;
  for (const BrepEdge& edge : brep.edges) samples.curves.push_back(edgeCurve(mesh, edge));
  const double reach = options.curvature ? kReachByCurvature : kReachByCount;
  const double largest = byCount ? reach * first : first;
  const InnerSources sources(mesh, brep, options, first);

  SizeField field;
  field.base = first;
  field.gradation = options.gradation;
  field.mostSagitta = kRoomForSagitta * arcSagitta(options.divisionsPerTurn);
  field.chordSize = options.chordSize.value_or(first * mean);
  if (options.curvature) field.chordSize = std::min(field.chordSize, *options.curvature / field.mostSagitta);
  field.limits = options.limits;
  CountSearch search(field.base);
  const auto wanted = static_cast<double>(options.quads.value_or(kDefaultQuads));
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (!progress.report(Stage::sizing, 0.05 * attempt)) return cancelledError();
    field.nominal = field.base * mean;
    if (sources.empty()) {
      resample(samples, field.base, kSampleSpacing * field.nominal);
    } else {
      field.inner = sources.sizes(field.base, options.gradation);
      if (countOf(field.inner) > static_cast<double>(kMostQuads)) return tooFine();
      resampleUnder(samples, field.base, kSampleSpacing, sources.alongEdges(brep, samples.curves, field.inner));
    }
    field.minimumDivisions = limitByTurning(samples, options.divisionsPerTurn, kLowestByTurning * field.nominal,
                                            field.mostSagitta * field.chordSize);
    limitByLength(samples, kLowestByLength * field.nominal);
    SampleGraph graph(samples, brep, options.limits);
    graph.grade(options.gradation);
    graph.store(samples, field.limits);
    if (!byCount || attempt + 1 == kAttempts) break;
    const double ratio =
        graph.count(mesh, brep, field.inner, options.gradation, divisionsOf(samples, field.minimumDivisions)) / wanted;
    if (std::fabs(ratio - 1.0) < kCountTolerance) break;
    field.base = std::clamp(search.next(field.base, ratio), first, largest);
  }
  const auto rows = findGaps(samples.curves, brep, kOneRow * field.nominal, kSampleSpacing * field.nominal, progress);
  if (!rows) return cancelledError();
  levelAcross(samples, *rows, kOneRow);
  field.sources = sources.counts(field.base);
  field.value = vertexSizes(mesh, brep, samples, field.inner, field.limits, options.gradation);
  field.edges = std::move(samples.sizes);
  return field;
}

}  // namespace qmcf
