#include "qmcf/sizing/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "edge_samples.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/sizing/min_heap.hpp"
#include "sample_graph.hpp"

namespace qmcf {
namespace {

// In units of the base size: how small the edges themselves may make an element.
constexpr double kLowestByTurning = 0.1;
constexpr double kLowestByProximity = 0.25;
constexpr double kLowestByLength = 0.3;
constexpr double kSampleSpacing = 0.5;
// The base size that makes the number of quads come out right is found by trying.
constexpr int kAttempts = 6;
constexpr double kCountTolerance = 0.02;
constexpr double kReachByCount = 3.0;
// A smooth arc in the least number of divisions, and some room for corners of its polygon.
constexpr double kRoomForSagitta = 1.1;
constexpr std::int64_t kDefaultQuads = 3000;
constexpr std::int64_t kMostQuads = 10'000'000;

Error invalid(std::string message) { return {ErrorCode::invalidOption, std::move(message), {}}; }

Result<double> baseSize(const Brep& brep, const SizingOptions& options) {
  if (options.size && options.quads) return invalid("Give either an element size or a number of quads, not both.");
  double area = 0.0;
  for (const BrepFace& face : brep.faces) area += face.area;
  if (!(area > 0.0)) return Error{ErrorCode::noSurface, "The part has no area to mesh.", {}};
  if (options.size) {
    if (!(*options.size > 0.0) || !std::isfinite(*options.size)) return invalid("The element size must be above 0.");
    if (area / *options.size / *options.size > static_cast<double>(kMostQuads)) {
      return invalid("This element size would take more than 10,000,000 quads; choose a larger one.");
    }
    return *options.size;
  }
  const std::int64_t quads = options.quads.value_or(kDefaultQuads);
  if (quads < 1 || quads > kMostQuads) return invalid("The number of quads must be between 1 and 10,000,000.");
  return std::sqrt(area / static_cast<double>(quads));
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

/// Neighbours along the edges of the triangles, as one flat table.
struct Adjacency {
  std::vector<std::size_t> first;
  std::vector<std::int32_t> vertex;
};

Adjacency adjacencyOf(const TriangleMesh& mesh) {
  Adjacency adjacency;
  adjacency.first.assign(mesh.positions.size() + 1, 0);
  for (const auto& t : mesh.triangles) {
    for (const std::int32_t v : t) adjacency.first[static_cast<std::size_t>(v) + 1] += 2;
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) adjacency.first[v + 1] += adjacency.first[v];
  adjacency.vertex.resize(adjacency.first.back());
  std::vector<std::size_t> next = adjacency.first;
  for (const auto& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto v = static_cast<std::size_t>(t[c]);
      adjacency.vertex[next[v]++] = t[(c + 1) % 3];
      adjacency.vertex[next[v]++] = t[(c + 2) % 3];
    }
  }
  return adjacency;
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

/// Sizes at the vertices of the mesh: those on edges are given, the others are graded along the triangles' edges.
std::vector<double> vertexSizes(const TriangleMesh& mesh, const Brep& brep, const EdgeSamples& samples,
                                const std::vector<SizeLimit>& limits, double gradation) {
  std::vector<double> value(mesh.positions.size(), samples.base);
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const EdgeCurve& curve = samples.curves[e];
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      double& v = value[static_cast<std::size_t>(brep.edges[e].points[i])];
      v = std::min(v, interpolate(samples.sizes[e].arcLength, samples.sizes[e].value, curve.arcLength[i]));
    }
  }
  applyLimits(value, mesh, brep, limits, gradation);
  MinHeap heap;
  for (std::size_t v = 0; v < value.size(); ++v) {
    if (value[v] < samples.base) heap.push(value[v], static_cast<std::int32_t>(v));
  }
  if (heap.empty()) return value;
  const Adjacency adjacency = adjacencyOf(mesh);
  while (!heap.empty()) {
    const auto [size, vertex] = heap.pop();
    const auto v = static_cast<std::size_t>(vertex);
    if (size > value[v]) continue;
    for (std::size_t i = adjacency.first[v]; i < adjacency.first[v + 1]; ++i) {
      const auto w = static_cast<std::size_t>(adjacency.vertex[i]);
      const double graded = size + gradation * distance(mesh.positions[v], mesh.positions[w]);
      if (!(graded < value[w])) continue;
      value[w] = graded;
      heap.push(graded, adjacency.vertex[i]);
    }
  }
  return value;
}

}  // namespace

Result<SizeField> computeSizeField(const TriangleMesh& mesh, const Brep& brep, const SizingOptions& options,
                                   Progress& progress) {
  if (!(options.gradation > 0.0) || options.gradation > 1.0) {
    return invalid("The gradation must be above 0 and at most 1.");
  }
  if (options.chordSize && !(*options.chordSize > 0.0)) return invalid("The chord size must be above 0.");
  if (options.divisionsPerTurn < 3) return invalid("A full turn needs at least 3 divisions.");
  const Result<double> base = baseSize(brep, options);
  if (!base.ok()) return base.error();
  if (!progress.report(Stage::sizing, 0.0)) return cancelledError();

  const bool byCount = !options.size;
  EdgeSamples samples;
  for (const BrepEdge& edge : brep.edges) samples.curves.push_back(edgeCurve(mesh, edge));
  // Room for a base that grows until the count fits.
  const double reach = byCount ? kReachByCount * base.value() : base.value();
  const auto gaps = findGaps(samples.curves, mesh, brep, reach, kSampleSpacing * base.value(), progress);
  if (!gaps) return cancelledError();

  SizeField field;
  field.base = base.value();
  field.gradation = options.gradation;
  field.mostSagitta = kRoomForSagitta * arcSagitta(options.divisionsPerTurn);
  field.chordSize = options.chordSize.value_or(base.value());
  field.limits = options.limits;
  CountSearch search(field.base);
  const auto wanted = static_cast<double>(options.quads.value_or(kDefaultQuads));
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (!progress.report(Stage::sizing, 0.6 + 0.05 * attempt)) return cancelledError();
    resample(samples, field.base, kSampleSpacing * field.base);
    field.minimumDivisions = limitByTurning(samples, options.divisionsPerTurn, kLowestByTurning * field.base,
                                            field.mostSagitta * field.chordSize);
    limitByLength(samples, kLowestByLength * field.base);
    limitByGaps(samples, *gaps, kLowestByProximity * field.base);
    SampleGraph graph(samples, brep, options.limits);
    graph.grade(options.gradation);
    graph.store(samples, field.limits);
    if (!byCount || attempt + 1 == kAttempts) break;
    const double ratio = graph.count(mesh, brep, options.gradation) / wanted;
    if (std::fabs(ratio - 1.0) < kCountTolerance) break;
    field.base = std::clamp(search.next(field.base, ratio), base.value(), reach);
  }
  levelAcross(samples, *gaps);
  field.value = vertexSizes(mesh, brep, samples, field.limits, options.gradation);
  field.edges = std::move(samples.sizes);
  return field;
}

}  // namespace qmcf
