// The only place that sees every stage: bytes are read before and written after it.
#include "qmcf/pipeline/mesh_surface.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "covered_faces.hpp"
#include "mesh_faces.hpp"
#include "prepare.hpp"
#include "too_coarse.hpp"

namespace qmcf {
namespace {

constexpr std::int64_t kDefaultQuads = 3000;
constexpr std::int64_t kMostQuads = 10'000'000;

MeshOptions withDefaults(MeshOptions options) {
  if (!options.size && !options.quads) options.quads = kDefaultQuads;
  return options;
}

/// As above, for a run that wants the field whatever front would ask it.
MeshOptions withField(MeshOptions options) {
  options.mode = Mode::qmcf;
  return withDefaults(std::move(options));
}

/// How often places where the mesh is not valid get smaller elements, and how small these may be in units of the base.
constexpr int kMaxRefinements = 4;
constexpr double kLowestSize = 0.15;
/// Two faces between the same edges that are nearer to each other than this, in units of the base, get one mesh.
constexpr double kTellApart = 0.25;

void turnRound(FaceMesh& mesh) {
  for (Element& element : mesh.elements) {
    std::swap(element[1], element[cornerCount(element) - 1]);
  }
}

MeshedFace omittedFace(std::int32_t face, std::int32_t below) {
  MeshedFace omitted;
  omitted.report.face = face;
  omitted.report.method = "omitted";
  omitted.report.reason = "it lies on face " + std::to_string(below) + ", nearer than elements of this size can tell";
  return omitted;
}

QualityOptions qualityOptions(const MeshOptions& options, double size) {
  QualityOptions quality;
  quality.featureAngle = options.featureAngle;
  quality.size = size;
  return quality;
}

/// What the report says about the faces, besides the quality.
void describe(MeshResult& result, const PreparedFaces& prepared, const std::vector<MeshedFace>& faces) {
  result.fieldSingularities = 0;
  for (const CrossField& field : prepared.fields) {
    result.fieldSingularities += static_cast<std::int64_t>(field.singularities.size());
  }
  result.faces.clear();
  for (const MeshedFace& face : faces) result.faces.push_back(face.report);
  result.refinedPlaces = static_cast<std::int64_t>(prepared.size.limits.size());
}

Error invalid(std::string message) { return {ErrorCode::invalidOption, std::move(message), {}}; }

}  // namespace

std::string_view modeName(Mode mode) { return mode == Mode::qmcf ? "qmcf" : "qmorph"; }

std::optional<Error> validateOptions(const MeshOptions& options) {
  if (options.size && options.quads) return invalid("Give either size or quads, not both.");
  if (options.size && !(std::isfinite(*options.size) && *options.size > 0.0)) {
    return invalid("size must be a positive length in units of the model.");
  }
  if (options.quads && (*options.quads < 1 || *options.quads > kMostQuads)) {
    return invalid("quads must be between 1 and 10,000,000.");
  }
  if (!(options.featureAngle > 0.0 && options.featureAngle < 180.0)) {
    return invalid("featureAngle must be between 0 and 180 degrees.");
  }
  if (!(options.gradation > 0.0 && options.gradation <= 1.0))
    return invalid("gradation must be above 0 and at most 1.");
  for (const FieldStroke& stroke : options.strokes) {
    const double length = norm(stroke.to - stroke.from);  // NaN or infinite if any coordinate is.
    if (!(length > 0.0 && std::isfinite(length))) return invalid("Each of the strokes must join two different points.");
  }
  return std::nullopt;
}

Result<InspectResult> inspectSurface(const TriangleMesh& input, const MeshOptions& options, Progress& progress) {
  if (const auto error = validateOptions(options)) return *error;
  InspectResult result;
  auto repaired = repair(input, RepairOptions{options.repair}, progress);
  if (!repaired) return repaired.error();
  result.repaired = std::move(repaired).value();
  auto brep = recoverBrep(result.repaired.mesh, BrepOptions{options.featureAngle}, progress);
  if (!brep) return brep.error();
  result.brep = std::move(brep).value();
  return result;
}

Result<FieldResult> computeField(const TriangleMesh& input, const MeshOptions& options, Progress& progress) {
  if (const auto error = validateOptions(options)) return *error;
  auto inspected = inspectSurface(input, options, progress);
  if (!inspected) return inspected.error();
  FieldResult result;
  result.input = std::move(inspected).value();
  auto prepared = prepareFaces(result.input.repaired.mesh, result.input.brep, withField(options), progress);
  if (!prepared) return prepared.error();
  result.size = prepared.value().size.base;
  result.patches = std::move(prepared.value().patches);
  result.fields = std::move(prepared.value().fields);
  return result;
}

Result<MeshResult> meshSurface(const TriangleMesh& input, const MeshOptions& options, Progress& progress) {
  if (const auto error = validateOptions(options)) return *error;
  auto inspected = inspectSurface(input, options, progress);
  if (!inspected) return inspected.error();
  MeshResult result;
  result.input = std::move(inspected).value();
  const TriangleMesh& mesh = result.input.repaired.mesh;
  const Brep& brep = result.input.brep;
  auto preparation = prepareFaces(mesh, brep, withDefaults(options), progress);
  if (!preparation) return preparation.error();
  PreparedFaces prepared = std::move(preparation).value();
  result.size = prepared.size.base;
  const CoveredFaces covered = coveredFaces(mesh, brep, kTellApart * result.size);
  std::vector<MeshedFace> faces(brep.faces.size());
  std::size_t fewest = 0;
  for (int attempt = 0;; ++attempt) {
    std::vector<SizeLimit> limits;
    for (const std::int32_t f : prepared.changed) {
      const std::int32_t below = covered.below[static_cast<std::size_t>(f)];
      if (below != kNone) {
        faces[static_cast<std::size_t>(f)] = omittedFace(f, below);
        continue;
      }
      auto face = meshFace(mesh, brep, prepared, f, options, progress);
      if (!face) return face.error();
      if (covered.turned[static_cast<std::size_t>(f)] != 0) turnRound(face.value().mesh);
      faces[static_cast<std::size_t>(f)] = std::move(face).value();
    }
    for (const MeshedFace& face : faces) limits.insert(limits.end(), face.tooCoarse.begin(), face.tooCoarse.end());
    QuadMesh joined = joinFaces(brep, prepared, faces);
    if (!progress.report(Stage::quality, 0.0)) return cancelledError();
    QualityReport quality = measureQuality(joined, &mesh, qualityOptions(options, result.size));
    const std::vector<SizeLimit> invalid = halvedWhereInvalid(joined, quality);
    limits.insert(limits.end(), invalid.begin(), invalid.end());
    if (attempt == 0 || limits.size() < fewest) {
      fewest = limits.size();
      result.mesh = std::move(joined);
      result.quality = std::move(quality);
      describe(result, prepared, faces);
    }
    limits = notBelow(limits, kLowestSize * result.size);
    if (limits.empty() || attempt == kMaxRefinements) return result;
    auto refined = refineFaces(mesh, brep, options, std::move(prepared), limits, progress);
    if (!refined) return refined.error();
    prepared = std::move(refined).value();
  }
}

}  // namespace qmcf
