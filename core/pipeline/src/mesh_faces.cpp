#include "mesh_faces.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

#include "qmcf/cleanup/cleanup.hpp"
#include "qmcf/cleanup/subdivide.hpp"
#include "qmcf/front/advancing_front.hpp"
#include "qmcf/front/strip.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/qmorph/qmorph.hpp"
#include "qmcf/quality/quality.hpp"
#include "qmcf/topology/brep.hpp"
#include "too_coarse.hpp"

namespace qmcf {
namespace {

void count(FaceReport& report, const FaceMesh& mesh) {
  report.quads = report.triangles = 0;
  for (const Element& element : mesh.elements) ++(cornerCount(element) == 4 ? report.quads : report.triangles);
}

/// Whether the ledger of a face's mesh closes with the Euler characteristic of the part's face, counted on the part.
[[maybe_unused]] bool ledgerCloses(const FaceMesh& made, const Part& part, std::int32_t face) {
  const IndexLedger ledger = indexLedger(made.positions, made.elements);
  return ledger.closes() &&
         ledger.sum() == 4 * part.brep.cuts[static_cast<std::size_t>(face)].surface.eulerCharacteristic();
}

/// Where a front that nothing else starts is tried, as shares of the triangles.
constexpr std::array<double, 4> kSeedPlaces{0.0, 0.37, 0.61, 0.83};

/// Area of a face mesh, and its share of triangles.
struct Yield {
  double area = 0.0;
  double triangleShare = 0.0;
};

Yield yieldOf(const FaceMesh& mesh) {
  Yield yield;
  for (const Element& element : mesh.elements) {
    const auto p = [&](std::size_t i) -> const Vec3& { return mesh.positions[static_cast<std::size_t>(element[i])]; };
    const bool quad = cornerCount(element) == 4;
    yield.area += 0.5 * norm(quad ? cross(p(2) - p(0), p(3) - p(1)) : cross(p(1) - p(0), p(2) - p(0)));
    yield.triangleShare += quad ? 0.0 : 1.0 / static_cast<double>(mesh.elements.size());
  }
  return yield;
}

/// Whether a front got stuck: most of what it should have made is bridged by triangles.
bool gotStuck(const FaceMesh& mesh, const Patch& patch) {
  constexpr double kMostTriangles = 0.3;
  constexpr double kLeastArea = 0.9;
  constexpr std::size_t kFew = 12;
  const Yield yield = yieldOf(mesh);
  const bool isSmall = mesh.elements.size() < kFew && patch.surface.triangleCount() < 4 * kFew;
  return !isSmall &&
         (yield.triangleShare > kMostTriangles || yield.area < kLeastArea * yieldOf(trianglesOf(patch)).area);
}

/// Elements that no solver takes.
std::vector<std::int32_t> unusableIn(const FaceMesh& mesh) {
  const EditMesh work(mesh);
  std::vector<std::int32_t> elements;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (isDegenerate(work, FaceId(e))) elements.push_back(static_cast<std::int32_t>(e));
  }
  return elements;
}

/// The front of the chosen mode, before the clean-up. seedPlace: where a front starts that nothing else does.
Result<FaceMesh> advance(const Patch& patch, const PreparedFaces& prepared, const TriangleBvh& tree, std::size_t face,
                         Mode mode, double seedPlace, Progress& progress, TraceRecorder* trace) {
  if (mode == Mode::qmorph) {
    auto front = advanceMorph(patch, tree, MorphOptions{}, progress, trace);
    if (!front) return front.error();
    return std::move(front.value().mesh);
  }
  FrontOptions frontOptions;
  frontOptions.seedPlace = seedPlace;
  auto front = advanceFront(patch, prepared.fields[face], frontOptions, progress, trace);
  if (!front) return front.error();
  return std::move(front.value().mesh);
}

/// A mesh of one row of elements with quadrilaterals only, each good enough: there is nothing to win by a front.
bool isGoodStrip(const FaceMesh& mesh) {
  constexpr double kGood = 0.5;
  return std::all_of(mesh.elements.begin(), mesh.elements.end(), [&](const Element& element) {
    return cornerCount(element) == 4 && elementShape(mesh, element) >= kGood;
  });
}

}  // namespace

Result<MeshedFace> meshFace(const Part& part, const PreparedFaces& prepared, std::int32_t face, Progress& progress) {
  const auto f = static_cast<std::size_t>(face);
  const Mode mode = part.options.mode;
  const Patch& patch = prepared.patches[f];
  const TriangleBvh& tree = part.faceTrees[f];
  MeshedFace result;
  result.report.face = face;
  std::optional<TraceRecorder> recorder;
  if (part.traceScale) recorder.emplace(result.trace, *part.traceScale);
  TraceRecorder* const trace = recorder ? &*recorder : nullptr;
  if (prepared.given[f] != Given::nothing) {
    const bool paired = prepared.given[f] == Given::pairs;
    result.mesh = paired ? recombinePatch(patch).mesh : trianglesOf(patch);
    result.report.method = "given";
    result.report.reason = "elements of no size tried gave a valid mesh: the part's own triangles";
    if (trace != nullptr) {
      EditMesh work(result.mesh);
      trace->begin(paired ? TraceKind::paired : TraceKind::triangulated, work);
    }
    assert(ledgerCloses(result.mesh, part, face));
    count(result.report, result.mesh);
    return result;
  }

  // The original has no such thing.
  std::optional<FaceMesh> strip = mode == Mode::qmcf ? meshStrip(patch) : std::nullopt;
  const auto takeStrip = [&] {
    result.mesh = std::move(*strip);
    result.report.method = "strip";
    if (trace != nullptr) {
      EditMesh work(result.mesh);
      trace->begin(TraceKind::strip, work);
    }
    assert(ledgerCloses(result.mesh, part, face));
    count(result.report, result.mesh);
    return std::move(result);
  };
  if (strip && isGoodStrip(*strip)) return takeStrip();

  // A front that got stuck may do better from another start, where the start is free.
  bool isStuck = true;
  Result<FaceMesh> front = FaceMesh{};
  for (std::size_t start = 0; isStuck && start < (part.brep.faces[f].loops.empty() ? kSeedPlaces.size() : 1); ++start) {
    front = advance(patch, prepared, tree, f, mode, kSeedPlaces[start], progress, trace);
    if (!front) return front.error();
    assert(ledgerCloses(front.value(), part, face));
    isStuck = gotStuck(front.value(), patch);
  }
  FaceMesh& made = front.value();
  std::vector<std::int32_t> unusable;
  if (isStuck) {
    unusable = unusableIn(made);
  } else {
    auto cleaned = cleanUp(made, patch, tree, CleanupOptions{}, progress, trace);
    if (!cleaned) return cleaned.error();
    made = std::move(cleaned.value().mesh);
    unusable = std::move(cleaned.value().degenerate);
    assert(ledgerCloses(made, part, face));
  }
  const bool isGood = unusable.empty() && !isStuck;
  if (strip && (!isGood || shapeCost(*strip) < shapeCost(made))) return takeStrip();
  if (isGood) {
    result.mesh = std::move(made);
    result.report.method = modeName(mode);
    count(result.report, result.mesh);
    return result;
  }
  result.report.reason = isStuck ? "the advancing front got stuck and left more than triangles can bridge well"
                                 : "the advancing front left elements without area or turned in on themselves";
  result.tooCoarse = halvedAt(made, unusable, face);
  auto paired = cleanUp(recombinePatch(patch).mesh, patch, tree, CleanupOptions{}, progress, trace, TraceKind::paired);
  if (!paired) return paired.error();
  if (paired.value().degenerate.empty()) {
    result.mesh = std::move(paired.value().mesh);
    result.report.method = "recombined";
  } else {
    result.mesh = trianglesOf(patch);
    result.report.method = "triangles";
    result.report.reason += ", and so did pairing triangles";
    if (trace != nullptr) {
      EditMesh work(result.mesh);
      trace->begin(TraceKind::triangulated, work);
    }
  }
  assert(ledgerCloses(result.mesh, part, face));
  count(result.report, result.mesh);
  return result;
}

SharedFace shareFace(const MeshedFace& face, const PreparedFaces& prepared) {
  SharedFace shared{face.mesh, {}, face.report, face.trace};
  const Patch& patch = prepared.patches[static_cast<std::size_t>(face.report.face)];
  for (const std::int32_t v : face.mesh.patchVertex) {
    shared.node.push_back(v == kNone ? kNone : patch.node[VertexId(v)]);
  }
  return shared;
}

SharedFace shareCut(const CutFace& face, const PreparedFaces& prepared, const SharedNodes& halved) {
  SharedFace shared{face.mesh, {}, face.report, face.trace};
  const Patch& patch = prepared.patches[static_cast<std::size_t>(face.report.face)];
  for (std::size_t v = 0; v < face.mesh.patchVertex.size(); ++v) {
    const std::int32_t before = face.mesh.patchVertex[v];
    const HalfedgeId half = face.halves[v];
    const std::int32_t whole = before == kNone ? kNone : patch.node[VertexId(before)];
    shared.node.push_back(half.valid() ? halvingNode(patch, half, prepared.divided, halved) : whole);
  }
  return shared;
}

Result<CutFace> cutFace(const Part& part, const PreparedFaces& prepared, const TriangleBvh& whole,
                        const MeshedFace& face, const SharedNodes& halved, Progress& progress) {
  const auto f = static_cast<std::size_t>(face.report.face);
  const Patch& patch = prepared.patches[f];
  const TriangleBvh& tree = part.faceTrees[f];
  IdMap<HalfedgeId, Vec3> middle(patch.surface.halfedgeCount());
  for (const HalfedgeId h : IdRange<HalfedgeId>(patch.surface.halfedgeCount())) {
    if (!patch.surface.isBoundary(h)) continue;
    middle[h] = halved.positions[static_cast<std::size_t>(halvingNode(patch, h, prepared.divided, halved))];
  }
  const bool isGiven = prepared.given[f] != Given::nothing;
  SubdividedFace cut = subdivide(face.mesh, patch, tree, middle, isGiven ? NewVertices::between : NewVertices::onFace);
  CutFace result{{}, {}, face.report, face.trace};
  std::optional<TraceRecorder> recorder;
  if (part.traceScale) recorder.emplace(result.trace, *part.traceScale);
  TraceRecorder* const trace = recorder ? &*recorder : nullptr;
  if (isGiven) {
    result.mesh = std::move(cut.mesh);
    result.halves = std::move(cut.boundaryEdge);
    if (trace != nullptr) {
      EditMesh work(result.mesh);
      trace->begin(TraceKind::subdivision, work);
    }
  } else {
    CleanupOptions options;
    options.topology = false;
    options.quadsOnly = true;
    options.sizeScale = 0.5;
    const WholePart around{whole, part.brep.faces[f].triangles};
    options.part = &around;
    auto relaxed = cleanUp(cut.mesh, patch, tree, options, progress, trace, TraceKind::subdivision);
    if (!relaxed) return relaxed.error();
    result.mesh = std::move(relaxed.value().mesh);
    for (const std::int32_t v : relaxed.value().before) {
      result.halves.push_back(v == kNone ? HalfedgeId() : cut.boundaryEdge[static_cast<std::size_t>(v)]);
    }
  }
  assert(ledgerCloses(result.mesh, part, face.report.face));
  count(result.report, result.mesh);
  return result;
}

namespace {

/// The face once more through the clean-up; as it is, if that would leave an element that no solver takes.
Result<MeshedFace> cleanAgain(const Part& part, const PreparedFaces& prepared, const MeshedFace& face,
                              const CleanupOptions& options, Progress& progress) {
  const auto f = static_cast<std::size_t>(face.report.face);
  MeshedFace result = face;
  std::optional<TraceRecorder> recorder;
  if (part.traceScale) recorder.emplace(result.trace, *part.traceScale);
  auto cleaned = cleanUp(face.mesh, prepared.patches[f], part.faceTrees[f], options, progress,
                         recorder ? &*recorder : nullptr, TraceKind::cleanup);
  if (!cleaned) return cleaned.error();
  if (!cleaned.value().degenerate.empty()) return face;
  result.mesh = std::move(cleaned.value().mesh);
  assert(ledgerCloses(result.mesh, part, face.report.face));
  count(result.report, result.mesh);
  return result;
}

}  // namespace

Result<MeshedFace> pairFace(const Part& part, const PreparedFaces& prepared, const MeshedFace& face,
                            Progress& progress) {
  CleanupOptions options;
  options.topology = false;
  options.pairAll = true;
  options.quadsOnly = true;
  return cleanAgain(part, prepared, face, options, progress);
}

Result<MeshedFace> mendFace(const Part& part, const PreparedFaces& prepared, const TriangleBvh& whole, bool quadsOnly,
                            const MeshedFace& face, Progress& progress) {
  const WholePart around{whole, part.brep.faces[static_cast<std::size_t>(face.report.face)].triangles};
  CleanupOptions options;
  options.topology = false;
  options.quadsOnly = quadsOnly;
  options.sweeps = 0;
  options.part = &around;
  return cleanAgain(part, prepared, face, options, progress);
}

}  // namespace qmcf
