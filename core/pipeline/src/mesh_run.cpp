// From an inspected part to its mesh, with everything that is tried when the first attempt is not valid.
#include "mesh_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "count_correction.hpp"
#include "covered_faces.hpp"
#include "join_faces.hpp"
#include "mesh_faces.hpp"
#include "prepare.hpp"
#include "qmcf/base/parallel.hpp"
#include "size_conformity.hpp"
#include "too_coarse.hpp"

namespace qmcf {
namespace {

/// How often places where the mesh is not valid get smaller elements, and how small these may be in units of the base.
constexpr int kMaxRefinements = 4;
constexpr double kLowestSize = 0.02;
/// A run that has to make so many times the elements of the first attempt, or twice the faults of the best, is lost.
constexpr double kMostGrowth = 1.5;
constexpr std::size_t kFewFaults = 10;
constexpr double kFewElements = 300.0;
/// How often faces are held where relaxing all together leaves elements that are not valid; the last time, all are.
constexpr int kMaxHolds = 3;
/// How often faces are made of the part's own triangles before a mesh is given up.
constexpr int kMaxGivenRounds = 5;
constexpr std::size_t kMostGiven = 10000;  ///< Triangles of such a face, besides twice the elements.
/// How often the number of elements asked of the size field is corrected by what the front made of it: large numbers,
/// which come out nearer by themselves, once.
constexpr int kMaxCorrections = 2;
constexpr std::int64_t kManyElements = 10'000;
/// Two faces between the same edges that are nearer to each other than this, in units of the base, get one mesh.
constexpr double kTellApart = 0.25;

void turnRound(FaceMesh& mesh) {
  for (Element& element : mesh.elements) {
    std::swap(element[1], element[cornerCount(element) - 1]);
  }
}

CoveredFaces noneCovered(const Brep& brep) {
  return {std::vector<std::int32_t>(brep.faces.size(), kNone), std::vector<std::uint8_t>(brep.faces.size(), 0)};
}

MeshedFace omittedFace(std::int32_t face, std::int32_t below) {
  MeshedFace omitted;
  omitted.report.face = face;
  omitted.report.method = "omitted";
  omitted.report.reason = "it lies on face " + std::to_string(below) + ", nearer than elements of this size can tell";
  return omitted;
}

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

QualityOptions qualityOptions(const MeshOptions& options, double size) {
  QualityOptions quality;
  quality.featureAngle = options.featureAngle;
  quality.size = size;
  return quality;
}

/// Meshes an inspected part; as long as the mesh is not valid and smaller elements may help, once more with these.
class MeshRun {
 public:
  MeshRun(const TriangleMesh& input, MeshResult inspected, const MeshOptions& options, Progress& progress)
      : result_(std::move(inspected)),
        inputPositions_(input.positions),
        mesh_(result_.input.repaired.mesh),
        brep_(result_.input.brep),
        options_(options),
        // Where all elements will be cut up, those before are twice as long.
        coarsening_(options.allQuad ? 2.0 : 1.0),
        progress_(progress) {
    if (options.trace) scale_ = traceScale(mesh_);
  }

  Result<MeshResult> run() {
    auto preparation = options_.quads ? prepareForCount(*options_.quads) : prepare(options_);
    if (!preparation) return preparation.error();
    PreparedFaces prepared = std::move(preparation).value();
    const double base = prepared.size.base;
    if (!options_.quads) askedBase_ = base;
    result_.size = askedBase_ / coarsening_;
    std::size_t fewest = 0;
    double mostElements = 0.0;
    for (int round = 0;; ++round) {
      if (round > 0) {
        if (const auto error = meshChanged(prepared)) return *error;
      }
      auto attempted = attempt(prepared);
      if (!attempted) return attempted.error();
      std::vector<SizeLimit> limits = std::move(attempted.value().limits);
      // Faces that are poorly covered are made anew as a whole, and count as one fault each.
      const auto missing = halvedWhereMissing(attempted.value().mesh, attempted.value().quality, brep_);
      const auto elements = static_cast<double>(attempted.value().mesh.elements.size());
      const auto missed = halvedWhereMissed(attempted.value().quality.missed, mesh_, brep_, prepared.size);
      const std::size_t faults = limits.size() + (missing.empty() ? 0 : 1) + missed.size();
      if (round == 0 || faults < fewest) {
        fewest = faults;
        if (const auto error = keep(std::move(attempted).value(), prepared)) return *error;
      }
      limits.insert(limits.end(), missing.begin(), missing.end());
      limits.insert(limits.end(), missed.begin(), missed.end());
      limits = notBelow(limits, kLowestSize * base);
      if (round == 0) mostElements = kMostGrowth * elements + kFewElements;
      const bool isLost = elements > mostElements || faults > 2 * fewest + kFewFaults;
      if (limits.empty() || isLost || round == kMaxRefinements) break;
      auto refined = refineFaces(mesh_, brep_, options_, std::move(prepared), limits, progress_);
      if (!refined) return refined.error();
      prepared = std::move(refined).value();
    }
    if (!result_.quality.valid) {
      if (const auto error = giveTriangles(std::move(prepared))) return *error;
    }
    return std::move(result_);
  }

 private:
  /// Where no size gave a valid mesh, the part's own triangles do, first in pairs, then as they are; whatever fails
  /// around them follows. last: what the present meshes of the faces were made of.
  std::optional<Error> giveTriangles(PreparedFaces last) {
    // A fine scan of which a few elements are not valid is not replaced by itself.
    const std::size_t mostTriangles = kMostGiven + 2 * result_.mesh.elements.size();
    std::vector<Given> given(brep_.faces.size(), Given::nothing);
    std::vector<std::int32_t> atFault = facesAtFault(result_.mesh, result_.quality, brep_);
    for (int round = 0; round < kMaxGivenRounds && !atFault.empty(); ++round) {
      bool changed = false;
      for (const std::int32_t face : atFault) {
        const auto f = static_cast<std::size_t>(face);
        if (brep_.faces[f].triangles.size() > mostTriangles) continue;
        Given& of = given[f];
        changed = changed || of != Given::triangles;
        of = of == Given::nothing ? Given::pairs : Given::triangles;
      }
      if (!changed) break;
      auto prepared = prepareGiven(mesh_, brep_, options_, sizes_, given, progress_);
      if (!prepared) return prepared.error();
      keepUnchanged(last, prepared.value());
      last = std::move(prepared).value();
      if (const auto error = meshChanged(last)) return error;
      const auto separate = shareFaces(last);
      if (!separate) return separate.error();
      auto made = join(last, separate.value(), std::vector<char>(faces_.size(), 1));
      if (!made) return made.error();
      atFault = facesAtFault(made.value().mesh, made.value().quality, brep_);
      if (countFaults(made.value().quality) < countFaults(result_.quality)) {
        if (const auto error = keep(std::move(made).value(), last)) return error;
      }
      if (result_.quality.valid) break;
    }
    return std::nullopt;
  }

  /// A mesh of the whole part.
  struct Attempt {
    QuadMesh mesh;
    std::vector<FaceReport> faces;
    std::vector<FaceTrace> traces;
    std::int64_t heldFaces = 0;
    std::int64_t slidNodes = 0;
    QualityReport quality;
    std::vector<SizeLimit> limits;  ///< Where smaller elements may make it valid.
  };

  /// Meshes that will share the nodes on their edges.
  struct SeparateFaces {
    SharedNodes nodes;
    std::vector<SharedFace> faces;
  };

  /// Everything from the sizes to the meshed faces.
  Result<PreparedFaces> prepare(const MeshOptions& options) {
    auto prepared = prepareFaces(mesh_, brep_, options, progress_);
    if (!prepared) return prepared;
    // Elements that are cut up have a vertex of their own each, so that those of two layers always are told apart.
    covered_ =
        options.allQuad ? noneCovered(brep_) : coveredFaces(mesh_, brep_, kTellApart * prepared.value().size.base);
    faces_.assign(brep_.faces.size(), MeshedFace{});
    if (const auto error = meshChanged(prepared.value())) return *error;
    return prepared;
  }

  /// The number of elements of the meshed faces, once they are joined.
  [[nodiscard]] double elementCount() const {
    std::int64_t quads = 0;
    std::int64_t triangles = 0;
    for (const MeshedFace& face : faces_) {
      quads += face.report.quads;
      triangles += face.report.triangles;
    }
    return static_cast<double>(options_.allQuad ? 4 * quads + 3 * triangles : quads + triangles);
  }

  /// Faces that are not meshed by the first way tried.
  static std::ptrdiff_t fallbacks(const std::vector<MeshedFace>& faces) {
    return std::count_if(faces.begin(), faces.end(),
                         [](const MeshedFace& face) { return !face.report.reason.empty(); });
  }

  /// As prepare(), with sizes such that there are about `wanted` elements in the end.
  Result<PreparedFaces> prepareForCount(std::int64_t wanted) {
    MeshOptions options = options_;
    options.quads = wanted;
    auto best = prepare(options);
    if (!best) return best;
    askedBase_ = best.value().size.base;
    CountTrial tried{wanted, elementCount()};
    options.quads = correctedCount(tried, wanted);
    const auto miss = [wanted](double made) { return std::fabs(made - static_cast<double>(wanted)); };
    const int most = wanted > kManyElements ? 1 : kMaxCorrections;
    for (int i = 0; i < most && options.quads != tried.asked; ++i) {
      CoveredFaces covered = covered_;
      std::vector<MeshedFace> faces = std::move(faces_);
      const std::ptrdiff_t fallbacksBefore = fallbacks(faces);
      auto next = prepare(options);
      if (!next) return next;
      const CountTrial now{*options.quads, elementCount()};
      options.quads = correctedCount(tried, now, wanted);
      if (miss(now.made) < miss(tried.made) && fallbacks(faces_) <= fallbacksBefore) {
        best = std::move(next);
        tried = now;
      } else {
        covered_ = std::move(covered);
        faces_ = std::move(faces);
      }
    }
    return best;
  }

  /// Calls work(face, progress) for each of the faces that are not omitted, several at a time.
  template <class Work>
  std::optional<Error> forEachFace(const PreparedFaces& prepared, const std::vector<std::int32_t>& faces, Work work) {
    std::vector<std::int32_t> meshed;
    std::vector<double> costs;
    for (const std::int32_t face : faces) {
      const auto f = static_cast<std::size_t>(face);
      if (covered_.below[f] != kNone) continue;
      meshed.push_back(face);
      costs.push_back(static_cast<double>(prepared.patches[f].surface.triangleCount()));
    }
    return parallelFor(costs, threadsOf(options_), progress_,
                       [&](std::size_t i, Progress& progress) { return work(meshed[i], progress); });
  }

  std::optional<Error> meshChanged(const PreparedFaces& prepared) {
    for (const std::int32_t face : prepared.changed) {
      const auto f = static_cast<std::size_t>(face);
      if (covered_.below[f] != kNone) faces_[f] = omittedFace(face, covered_.below[f]);
    }
    return forEachFace(prepared, prepared.changed, [&](std::int32_t face, Progress& progress) -> std::optional<Error> {
      auto meshed = meshFace(mesh_, brep_, prepared, face, options_, scale_, progress);
      if (!meshed) return meshed.error();
      faces_[static_cast<std::size_t>(face)] = std::move(meshed).value();
      return std::nullopt;
    });
  }

  /// Cuts up the faces that were meshed since it was called last.
  std::optional<Error> cutMeshed(const PreparedFaces& prepared, const SharedNodes& halved) {
    std::vector<std::int32_t> uncut;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (!faces_[f].cut) uncut.push_back(static_cast<std::int32_t>(f));
    }
    const TriangleBvh part(mesh_.positions, mesh_.triangles);
    return forEachFace(prepared, uncut, [&](std::int32_t face, Progress& progress) -> std::optional<Error> {
      MeshedFace& meshed = faces_[static_cast<std::size_t>(face)];
      auto cut = cutFace(mesh_, brep_, prepared, part, meshed, halved, scale_, progress);
      if (!cut) return cut.error();
      meshed.cut = std::move(cut).value();
      return std::nullopt;
    });
  }

  /// The faces' meshes as one, relaxed together. Faces that this would cost their validity are held, in the end all.
  Result<Attempt> attempt(const PreparedFaces& prepared) {
    const auto faultsOf = [](const Attempt& made) { return halvedWhereInvalid(made.mesh, made.quality); };
    std::vector<char> held(faces_.size(), 0);
    const auto separate = shareFaces(prepared);
    if (!separate) return separate.error();
    auto best = join(prepared, separate.value(), held);
    if (!best) return best;
    std::vector<SizeLimit> faults = faultsOf(best.value());
    for (int round = 0; round < kMaxHolds && !faults.empty(); ++round) {
      for (const SizeLimit& fault : faults) held[static_cast<std::size_t>(fault.face)] = 1;
      if (round + 1 == kMaxHolds) held.assign(held.size(), 1);
      auto made = join(prepared, separate.value(), held);
      if (!made) return made;
      faults = faultsOf(made.value());
      if (faults.size() < faultsOf(best.value()).size()) best = std::move(made);
    }
    return best;
  }

  /// The faces' meshes as they are joined, cut up if there shall be quadrilaterals only.
  Result<SeparateFaces> shareFaces(const PreparedFaces& prepared) {
    SeparateFaces separate;
    separate.nodes = options_.allQuad ? halvedNodes(mesh_, brep_, prepared.divided) : sharedNodes(prepared.divided);
    if (options_.allQuad) {
      if (const auto error = cutMeshed(prepared, separate.nodes)) return *error;
    }
    for (const MeshedFace& face : faces_) {
      separate.faces.push_back(face.cut ? shareCut(*face.cut, prepared, separate.nodes) : shareFace(face, prepared));
    }
    return separate;
  }

  /// held: per face, 1 if it is not relaxed with the others.
  Result<Attempt> join(const PreparedFaces& prepared, const SeparateFaces& separate, const std::vector<char>& held) {
    Attempt made;
    SharedNodes shared = separate.nodes;
    std::vector<SharedFace> faces = separate.faces;
    const auto slid = relaxJoint(mesh_, brep_, prepared, faces, held, shared, 1.0 / coarsening_, progress_);
    if (!slid) return slid.error();
    made.slidNodes = slid.value();
    made.heldFaces = std::count(held.begin(), held.end(), 1);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (covered_.turned[f] != 0) turnRound(faces[f].mesh);
    }
    made.mesh = joinFaces(shared, faces);
    for (SharedFace& face : faces) {
      made.faces.push_back(std::move(face.report));
      if (scale_) made.traces.push_back(std::move(face.trace));
    }
    if (!progress_.report(Stage::quality, 0.0)) return cancelledError();
    made.quality = measureQuality(made.mesh, &mesh_, qualityOptions(options_, result_.size));
    made.limits = tooCoarse(made.mesh, made.quality);
    return made;
  }

  /// Where smaller elements may make the mesh valid.
  [[nodiscard]] std::vector<SizeLimit> tooCoarse(const QuadMesh& joined, const QualityReport& quality) const {
    std::vector<SizeLimit> limits;
    for (const MeshedFace& face : faces_) limits.insert(limits.end(), face.tooCoarse.begin(), face.tooCoarse.end());
    for (SizeLimit limit : halvedWhereInvalid(joined, quality)) {
      limit.size *= coarsening_;
      limits.push_back(limit);
    }
    return limits;
  }

  std::optional<Error> keep(Attempt made, const PreparedFaces& prepared) {
    result_.mesh = std::move(made.mesh);
    result_.faces = std::move(made.faces);
    if (scale_) result_.trace = MeshTrace{*scale_, std::move(made.traces)};
    result_.quality = std::move(made.quality);
    result_.heldFaces = made.heldFaces;
    result_.slidNodes = made.slidNodes;
    result_.fieldSingularities = 0;
    for (const CrossField& field : prepared.fields) {
      result_.fieldSingularities += static_cast<std::int64_t>(field.singularities.size());
    }
    result_.sizing = prepared.size.sources;
    result_.refinedPlaces = static_cast<std::int64_t>(prepared.size.limits.size());
    sizes_ = {prepared.size.base, prepared.size.limits, prepared.minimumDivisions, prepared.size.chordSize};
    // Where the count was corrected, the sizes used are not those that were asked for.
    std::optional<SizeField> asked;
    if (askedBase_ != prepared.size.base) {
      PreparedSizes sizes = sizes_;
      sizes.base = askedBase_;
      auto field = sizeField(mesh_, brep_, options_, sizes, progress_);
      if (!field) return field.error();
      asked = std::move(field).value();
    }
    result_.sizeConformity = sizeConformity(result_.mesh, mesh_, prepared, asked ? &*asked : nullptr, coarsening_);
    result_.vertexSize = sizesAt(inputPositions_, mesh_, asked ? *asked : prepared.size, coarsening_);
    return std::nullopt;
  }

  MeshResult result_;
  const std::vector<Vec3>& inputPositions_;
  const TriangleMesh& mesh_;
  const Brep& brep_;
  MeshOptions options_;
  double coarsening_;
  Progress& progress_;
  std::optional<TraceScale> scale_;  ///< Of the trace, if one is asked for.
  CoveredFaces covered_;
  std::vector<MeshedFace> faces_;
  PreparedSizes sizes_;     ///< Of the mesh that is kept.
  double askedBase_ = 0.0;  ///< The base size for the number of elements wanted, before that was corrected.
};

}  // namespace

Result<MeshResult> meshInspected(const TriangleMesh& input, InspectResult inspected, const MeshOptions& options,
                                 Progress& progress) {
  MeshResult result;
  result.input = std::move(inspected);
  return MeshRun(input, std::move(result), options, progress).run();
}

}  // namespace qmcf
