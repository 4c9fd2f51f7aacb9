// From an inspected part to its mesh, with everything that is tried when the first attempt is not valid.
#include "mesh_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "choose_sizes.hpp"
#include "join_faces.hpp"
#include "mesh_faces.hpp"
#include "prepare.hpp"
#include "size_conformity.hpp"
#include "too_coarse.hpp"
#include "trial.hpp"

namespace qmcf {
namespace {

/// How often places where the mesh is not valid get smaller elements, and how small these may be in units of the base.
constexpr int kMaxRefinements = 4;
constexpr double kLowestSize = 0.01;
/// A run that has to make so many times the elements of the first attempt, or twice the faults of the best, is lost.
constexpr double kMostGrowth = 1.5;
constexpr std::size_t kFewFaults = 10;
constexpr double kFewElements = 300.0;
/// What is held where relaxing all together leaves elements that are not valid: at first what is so many elements away
/// from these, then their faces, then all.
constexpr std::array<double, 2> kHeldElements{3.0, 6.0};
constexpr std::size_t kMaxHolds = kHeldElements.size() + 1;
constexpr std::size_t kMostHeldPlaces = 1000;  ///< Where there are more faults their faces are held at once.
/// Where more than one of so many elements is a triangle that could not be paired, smaller ones won't help; nor where
/// they did not so often.
constexpr double kElementsPerUnpaired = 50.0;
constexpr int kMostInVain = 2;
/// How often faces are made of the part's own triangles before a mesh is given up.
constexpr int kMaxGivenRounds = 5;
constexpr std::size_t kMostGiven = 10000;  ///< Triangles of such a face, besides twice the elements.

void turnRound(FaceMesh& mesh) {
  for (Element& element : mesh.elements) {
    std::swap(element[1], element[cornerCount(element) - 1]);
  }
}

/// Whether each of the faces that have a limit has one for at least half of its elements.
bool areMostlyAtFault(const std::vector<SizeLimit>& limits, const QuadMesh& mesh) {
  std::map<std::int32_t, std::int64_t> surplus;  // Per face: twice its limits less its elements.
  for (const SizeLimit& limit : limits) surplus[limit.face] += 2;
  for (const std::int32_t face : mesh.elementFace) {
    if (const auto at = surplus.find(face); at != surplus.end()) --at->second;
  }
  return std::all_of(surplus.begin(), surplus.end(), [](const auto& of) { return of.second >= 0; });
}

QualityOptions qualityOptions(const MeshOptions& options, double size) {
  QualityOptions quality;
  quality.featureAngle = options.featureAngle;
  quality.size = size;
  return quality;
}

/// Adds what is around a point, or makes the place larger that it is in already.
void holdPlace(std::vector<Ball>& places, const Vec3& centre, double radius) {
  const auto around = std::find_if(places.begin(), places.end(),
                                   [&](const Ball& place) { return distance(place.centre, centre) <= place.radius; });
  if (around == places.end()) {
    places.push_back({centre, radius});
  } else {
    around->radius = std::max(around->radius, radius);
  }
}

/// Meshes an inspected part; as long as the mesh is not valid and smaller elements may help, once more with these.
class MeshRun {
 public:
  MeshRun(const TriangleMesh& input, MeshResult inspected, const RunOptions& options, Progress& progress,
          SizingMesh* sizing)
      : result_(std::move(inspected)),
        inputPositions_(input.positions),
        mesh_(result_.input.repaired.mesh),
        brep_(result_.input.brep),
        options_(options),
        part_(mesh_, brep_, options_),
        // Where all elements will be cut up, those before are twice as long.
        coarsening_(options.leftovers == Leftovers::cut ? 2.0 : 1.0),
        progress_(progress),
        sizing_(sizing) {}

  Result<MeshResult> run() {
    auto chosen = chooseSizes(part_, progress_);
    if (!chosen) return chosen.error();
    sizes_ = std::move(chosen).value();
    PreparedFaces& prepared = sizes_.trial.prepared;
    const double base = prepared.size.base;
    result_.size = sizes_.askedBase * (prepared.size.nominal / base) / coarsening_;
    std::size_t fewest = 0;
    double mostElements = 0.0;
    int roundsInVain = 0;
    for (int round = 0;; ++round) {
      if (round > 0) {
        if (const auto error = meshChanged(part_, sizes_.trial, progress_)) return *error;
      }
      auto attempted = attempt();
      if (!attempted) return attempted.error();
      std::vector<SizeLimit> limits = std::move(attempted.value().limits);
      // What is poorly covered counts as one fault.
      const auto missing =
          beforeCuts(halvedWhereMissing(attempted.value().mesh, attempted.value().quality, mesh_, brep_));
      const auto elements = static_cast<double>(attempted.value().mesh.elements.size());
      const auto missed = halvedWhereMissed(attempted.value().quality.missed, mesh_, brep_, prepared.size);
      const std::size_t faults = limits.size() + (missing.empty() ? 0 : 1) + missed.size();
      std::vector<std::int32_t> tiny;
      if (round > 0) tiny = tinyFacesAtFault(attempted.value());
      // A face that lies on another is at fault in any number of elements.
      const bool isFutile =
          round > 0 && faults > fewest && faults == limits.size() && areMostlyAtFault(limits, attempted.value().mesh);
      const bool isBetter = round == 0 || faults < fewest;
      roundsInVain = isBetter ? 0 : roundsInVain + 1;
      if (isBetter) {
        fewest = faults;
        if (const auto error = keep(std::move(attempted).value())) return *error;
      }
      limits.insert(limits.end(), missing.begin(), missing.end());
      limits.insert(limits.end(), missed.begin(), missed.end());
      limits = notBelow(limits, kLowestSize * base);
      std::erase_if(
          limits, [&tiny](const SizeLimit& limit) { return std::binary_search(tiny.begin(), tiny.end(), limit.face); });
      if (round == 0) mostElements = kMostGrowth * elements + kFewElements;
      // Half the size all over takes four times as many.
      if (!missing.empty()) mostElements = std::max(mostElements, 4.0 * elements + kFewElements);
      const bool isUnpaired = options_.leftovers == Leftovers::paired &&
                              (roundsInVain == kMostInVain ||
                               kElementsPerUnpaired * static_cast<double>(result_.quality.triangles) > elements);
      const bool isLost = isUnpaired || elements > mostElements || faults > 2 * fewest + kFewFaults || isFutile;
      if ((limits.empty() && tiny.empty()) || isLost || round == kMaxRefinements) break;
      auto refined = tiny.empty() ? refineFaces(mesh_, brep_, options_, scale(), std::move(prepared), limits, progress_)
                                  : giveTiny(tiny, limits);
      if (!refined) return refined.error();
      prepared = std::move(refined).value();
    }
    if (!result_.quality.valid && options_.leftovers != Leftovers::paired) {
      if (const auto error = giveTriangles()) return *error;
    }
    return std::move(result_);
  }

 private:
  /// Where no size gave a valid mesh, the part's own triangles do, first in pairs, then as they are; whatever fails
  /// around them follows.
  std::optional<Error> giveTriangles() {
    // A fine scan of which a few elements are not valid is not replaced by itself.
    const std::size_t mostTriangles = kMostGiven + 2 * result_.mesh.elements.size();
    std::vector<Given> given = keptGiven_;
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
      auto prepared = prepareGiven(mesh_, brep_, options_, scale(), keptSizes_, given, progress_);
      if (!prepared) return prepared.error();
      keepUnchanged(sizes_.trial.prepared, prepared.value());
      sizes_.trial.prepared = std::move(prepared).value();
      if (const auto error = meshChanged(part_, sizes_.trial, progress_)) return error;
      auto made = attempt();
      if (!made) return made.error();
      atFault = facesAtFault(made.value().mesh, made.value().quality, brep_);
      if (countFaults(made.value().quality) < countFaults(result_.quality)) {
        if (const auto error = keep(std::move(made).value())) return error;
      }
      if (result_.quality.valid) break;
    }
    return std::nullopt;
  }

  /// What the sizes are multiplied by.
  [[nodiscard]] const SizeScale* scale() const { return sizes_.scale.empty() ? nullptr : &sizes_.scale; }

  /// A mesh of the whole part.
  struct Attempt {
    QuadMesh mesh;
    std::vector<FaceReport> faces;
    std::vector<FaceTrace> traces;
    std::int64_t heldFaces = 0;
    std::int64_t heldPlaces = 0;
    std::int64_t slidNodes = 0;
    QualityReport quality;
    std::vector<SizeLimit> limits;  ///< Where smaller elements may make it valid.
  };

  /// Faces at fault that are not made of the part's own triangles, ascending.
  [[nodiscard]] std::vector<std::int32_t> meshedFacesAtFault(const Attempt& made) const {
    std::vector<std::int32_t> faces = facesAtFault(made.mesh, made.quality, brep_);
    std::erase_if(faces, [&](std::int32_t face) {
      return sizes_.trial.prepared.given[static_cast<std::size_t>(face)] != Given::nothing;
    });
    return faces;
  }

  /// Those that are smaller than an element: if smaller elements did not help once they won't, and the face's own
  /// triangles are not too coarse.
  [[nodiscard]] std::vector<std::int32_t> tinyFacesAtFault(const Attempt& made) const {
    const double base = sizes_.trial.prepared.size.base;
    std::vector<std::int32_t> faces = meshedFacesAtFault(made);
    std::erase_if(faces,
                  [&](std::int32_t face) { return brep_.faces[static_cast<std::size_t>(face)].area > base * base; });
    return faces;
  }

  /// Makes these faces of the part's own triangles, and puts smaller elements where others ask for them.
  Result<PreparedFaces> giveTiny(const std::vector<std::int32_t>& faces, const std::vector<SizeLimit>& limits) {
    const PreparedFaces& before = sizes_.trial.prepared;
    PreparedSizes sizes{before.size.base, before.size.limits, before.minimumDivisions, before.size.chordSize};
    sizes.limits.insert(sizes.limits.end(), limits.begin(), limits.end());
    std::vector<Given> given = before.given;
    for (const std::int32_t face : faces) given[static_cast<std::size_t>(face)] = Given::triangles;
    auto prepared = prepareGiven(mesh_, brep_, options_, scale(), sizes, given, progress_);
    if (prepared) keepUnchanged(before, prepared.value());
    return prepared;
  }

  /// Meshes that will share the nodes on their edges.
  struct SeparateFaces {
    SharedNodes nodes;
    std::vector<SharedFace> faces;
  };

  /// Cuts up the faces that were meshed since it was called last.
  std::optional<Error> cutMeshed(const SharedNodes& halved) {
    Trial& trial = sizes_.trial;
    std::vector<std::int32_t> uncut;
    for (std::size_t f = 0; f < trial.faces.size(); ++f) {
      if (!trial.faces[f].cut) uncut.push_back(static_cast<std::int32_t>(f));
    }
    const TriangleBvh whole(mesh_.positions, mesh_.triangles);
    const auto cut = [&](std::int32_t face, Progress& progress) -> std::optional<Error> {
      MeshedFace& meshed = trial.faces[static_cast<std::size_t>(face)];
      auto made = cutFace(part_, trial.prepared, whole, meshed, halved, progress);
      if (!made) return made.error();
      meshed.cut = std::move(made).value();
      return std::nullopt;
    };
    return forEachFace(part_, trial, uncut, progress_, cut);
  }

  /// The elements for which a joined mesh is not valid, with half their lengths.
  static std::vector<SizeLimit> faultsOf(const Attempt& made) { return halvedWhereInvalid(made.mesh, made.quality); }

  /// The faces' meshes as one. Where that is not valid, elements that are turned over are turned back in the faces'
  /// meshes; with quadrilaterals only that has been done already.
  Result<Attempt> attempt() {
    if (options_.leftovers == Leftovers::paired) {
      if (const auto error = pairTriangles()) return *error;
    }
    auto first = joinHolding();
    if (!first || options_.leftovers == Leftovers::cut) return first;
    const std::vector<std::int32_t> faces = meshedFacesAtFault(first.value());
    if (faces.empty()) return first;
    const auto isChanged = mendFaces(faces);
    if (!isChanged) return isChanged.error();
    if (!isChanged.value()) return first;
    auto second = joinHolding();
    const bool takesSecond = !second || faultsOf(second.value()).size() < faultsOf(first.value()).size();
    return takesSecond ? std::move(second) : std::move(first);
  }

  /// Makes quadrilaterals of the triangles in the faces' meshes.
  std::optional<Error> pairTriangles() {
    Trial& trial = sizes_.trial;
    std::vector<std::int32_t> faces;
    for (const MeshedFace& face : trial.faces) {
      if (face.report.triangles > 0) faces.push_back(face.report.face);
    }
    const auto pair = [&](std::int32_t face, Progress& progress) -> std::optional<Error> {
      MeshedFace& meshed = trial.faces[static_cast<std::size_t>(face)];
      auto paired = pairFace(part_, trial.prepared, meshed, progress);
      if (!paired) return paired.error();
      meshed = std::move(paired).value();
      return std::nullopt;
    };
    return forEachFace(part_, trial, faces, progress_, pair);
  }

  /// Turns back what is turned over in the meshes of these faces. Returns whether any mesh is another one now.
  Result<bool> mendFaces(const std::vector<std::int32_t>& faces) {
    Trial& trial = sizes_.trial;
    const TriangleBvh whole(mesh_.positions, mesh_.triangles);
    std::vector<std::uint8_t> changed(trial.faces.size(), 0);
    const auto mend = [&](std::int32_t face, Progress& progress) -> std::optional<Error> {
      const auto f = static_cast<std::size_t>(face);
      MeshedFace& meshed = trial.faces[f];
      auto mended = mendFace(part_, trial.prepared, whole, options_.leftovers == Leftovers::paired, meshed, progress);
      if (!mended) return mended.error();
      const FaceMesh& now = mended.value().mesh;
      changed[f] = now.elements != meshed.mesh.elements || now.positions != meshed.mesh.positions ? 1 : 0;
      meshed = std::move(mended).value();
      return std::nullopt;
    };
    if (const auto error = forEachFace(part_, trial, faces, progress_, mend)) return *error;
    return std::count(changed.begin(), changed.end(), 1) > 0;
  }

  /// The faces' meshes as one, relaxed together. Places that this would cost their validity are held, then their faces,
  /// in the end all.
  Result<Attempt> joinHolding() {
    Held held;
    held.places.resize(brep_.faces.size());
    // The part's own triangles are where they belong.
    for (const Given given : sizes_.trial.prepared.given) held.faces.push_back(given == Given::nothing ? 0 : 1);
    const auto separate = shareFaces();
    if (!separate) return separate.error();
    auto best = join(separate.value(), held);
    if (!best) return best;
    std::vector<SizeLimit> faults = faultsOf(best.value());
    if (faults.empty()) return best;
    // What is not valid in the faces' own meshes stays so, whatever is held.
    Held everything = held;
    everything.faces.assign(held.faces.size(), 1);
    auto unrelaxed = join(separate.value(), everything);
    if (!unrelaxed) return unrelaxed;
    const std::size_t least = faultsOf(unrelaxed.value()).size();
    for (std::size_t round = 0; round < kMaxHolds && faults.size() > least; ++round) {
      for (const SizeLimit& fault : faults) {
        const auto f = static_cast<std::size_t>(fault.face);
        if (round < kHeldElements.size() && faults.size() <= kMostHeldPlaces) {
          // The limit is half the size of the element at fault.
          holdPlace(held.places[f], fault.position, 2.0 * kHeldElements[round] * fault.size);
        } else {
          held.faces[f] = 1;
        }
      }
      auto made = join(separate.value(), held);
      if (!made) return made;
      faults = faultsOf(made.value());
      if (faults.size() < faultsOf(best.value()).size()) best = std::move(made);
    }
    if (least < faultsOf(best.value()).size()) best = std::move(unrelaxed);
    return best;
  }

  /// The faces' meshes as they are joined, cut up if there shall be quadrilaterals only.
  Result<SeparateFaces> shareFaces() {
    const PreparedFaces& prepared = sizes_.trial.prepared;
    SeparateFaces separate;
    separate.nodes = options_.leftovers == Leftovers::cut ? halvedNodes(mesh_, brep_, prepared.divided)
                                                          : sharedNodes(prepared.divided);
    if (options_.leftovers == Leftovers::cut) {
      if (const auto error = cutMeshed(separate.nodes)) return *error;
    }
    for (const MeshedFace& face : sizes_.trial.faces) {
      separate.faces.push_back(face.cut ? shareCut(*face.cut, prepared, separate.nodes) : shareFace(face, prepared));
    }
    return separate;
  }

  Result<Attempt> join(const SeparateFaces& separate, const Held& held) {
    const Trial& trial = sizes_.trial;
    Attempt made;
    SharedNodes shared = separate.nodes;
    std::vector<SharedFace> faces = separate.faces;
    const auto slid = relaxJoint(part_, trial.prepared, faces, held, shared, 1.0 / coarsening_, progress_);
    if (!slid) return slid.error();
    made.slidNodes = slid.value();
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (trial.prepared.given[f] != Given::nothing) continue;
      made.heldFaces += held.faces[f];
      made.heldPlaces += held.faces[f] != 0 ? 0 : static_cast<std::int64_t>(held.places[f].size());
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (trial.covered.turned[f] != 0) turnRound(faces[f].mesh);
    }
    made.mesh = joinFaces(shared, faces);
    for (SharedFace& face : faces) {
      made.faces.push_back(std::move(face.report));
      if (part_.traceScale) made.traces.push_back(std::move(face.trace));
    }
    if (!progress_.report(Stage::quality, 0.0)) return cancelledError();
    made.quality = measureQuality(made.mesh, &mesh_, qualityOptions(options_, result_.size));
    made.limits = tooCoarse(made.mesh, made.quality);
    return made;
  }

  /// Where smaller elements may make the mesh valid.
  [[nodiscard]] std::vector<SizeLimit> tooCoarse(const QuadMesh& joined, const QualityReport& quality) const {
    std::vector<SizeLimit> limits;
    for (const MeshedFace& face : sizes_.trial.faces)
      limits.insert(limits.end(), face.tooCoarse.begin(), face.tooCoarse.end());
    const auto invalid = beforeCuts(halvedWhereInvalid(joined, quality));
    limits.insert(limits.end(), invalid.begin(), invalid.end());
    if (options_.leftovers == Leftovers::paired) {
      const auto unpaired = halvedAtTriangles(joined);
      limits.insert(limits.end(), unpaired.begin(), unpaired.end());
    }
    return limits;
  }

  /// Sizes of elements of the joined mesh as those of the elements that these are cut from.
  [[nodiscard]] std::vector<SizeLimit> beforeCuts(std::vector<SizeLimit> limits) const {
    for (SizeLimit& limit : limits) limit.size *= coarsening_;
    return limits;
  }

  std::optional<Error> keep(Attempt made) {
    const PreparedFaces& prepared = sizes_.trial.prepared;
    result_.mesh = std::move(made.mesh);
    result_.faces = std::move(made.faces);
    if (part_.traceScale) result_.trace = MeshTrace{*part_.traceScale, std::move(made.traces)};
    result_.quality = std::move(made.quality);
    result_.heldFaces = made.heldFaces;
    result_.heldPlaces = made.heldPlaces;
    result_.slidNodes = made.slidNodes;
    result_.elementsCut = options_.leftovers == Leftovers::cut;
    result_.fieldSingularities = 0;
    for (const CrossField& field : prepared.fields) {
      result_.fieldSingularities += static_cast<std::int64_t>(field.singularities.size());
    }
    result_.fittedSizes = !sizes_.scale.empty() || std::count(prepared.settled.begin(), prepared.settled.end(), 1) > 0;
    result_.sizing = prepared.size.sources;
    result_.refinedPlaces = static_cast<std::int64_t>(prepared.size.limits.size());
    keptSizes_ = {prepared.size.base, prepared.size.limits, prepared.minimumDivisions, prepared.size.chordSize};
    keptGiven_ = prepared.given;
    // Where the count was corrected, the sizes used are not those that were asked for.
    std::optional<SizeField> asked;
    if (sizes_.askedBase != prepared.size.base) {
      PreparedSizes sizes = keptSizes_;
      sizes.base = sizes_.askedBase;
      auto field = sizeField(mesh_, brep_, options_, scale(), sizes, progress_);
      if (!field) return field.error();
      asked = std::move(field).value();
    }
    const SizeField* other = asked ? &*asked : nullptr;
    result_.sizeConformity = sizeConformity(result_.mesh, mesh_, prepared, other, coarsening_);
    if (sizing_ != nullptr) *sizing_ = sizingMeshOf(mesh_, prepared, other, coarsening_);
    result_.vertexSize = options_.fitSizes.value_or(false)
                             ? settledSizesAt(inputPositions_, mesh_, prepared, other, coarsening_)
                             : sizesAt(inputPositions_, mesh_, asked ? *asked : prepared.size, coarsening_);
    return std::nullopt;
  }

  MeshResult result_;
  const std::vector<Vec3>& inputPositions_;
  const TriangleMesh& mesh_;
  const Brep& brep_;
  RunOptions options_;
  Part part_;
  double coarsening_;
  Progress& progress_;
  SizingMesh* sizing_;       ///< Of the mesh that is kept; nullptr: nobody wants it.
  ChosenSizes sizes_;        ///< And what the last attempt was made of.
  PreparedSizes keptSizes_;  ///< Of the mesh that is kept.
  std::vector<Given> keptGiven_;
};

/// Whether a run has made what is asked for with quadrilaterals only. Cutting leaves out no face.
bool isWholeWithQuads(const MeshResult& made) {
  const auto isOmitted = [](const FaceReport& face) { return face.method == "omitted"; };
  return made.quality.valid && made.quality.triangles == 0 &&
         std::none_of(made.faces.begin(), made.faces.end(), isOmitted);
}

}  // namespace

Result<MeshResult> meshInspected(const TriangleMesh& input, InspectResult inspected, const MeshOptions& options,
                                 Progress& progress, SizingMesh* sizing) {
  MeshResult result;
  result.input = std::move(inspected);
  RunOptions run{options, Leftovers::stay};
  if (options.allQuad) {
    run.leftovers = Leftovers::paired;
    auto paired = MeshRun(input, result, run, progress, sizing).run();
    if (!paired || isWholeWithQuads(paired.value())) return paired;
    run.leftovers = Leftovers::cut;
  }
  return MeshRun(input, std::move(result), run, progress, sizing).run();
}

}  // namespace qmcf
