// The only place that sees every stage: bytes are read before and written after it.
#include "qmcf/pipeline/mesh_surface.hpp"

#include <cmath>
#include <utility>

#include "mesh_faces.hpp"
#include "prepare.hpp"

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
  return std::nullopt;
}

Result<InspectResult> inspectSurface(const TriangleMesh& input, double featureAngle, Progress& progress) {
  MeshOptions options;
  options.featureAngle = featureAngle;
  if (const auto error = validateOptions(options)) return *error;
  InspectResult result;
  auto repaired = repair(input, RepairOptions{}, progress);
  if (!repaired) return repaired.error();
  result.repaired = std::move(repaired).value();
  auto brep = recoverBrep(result.repaired.mesh, BrepOptions{featureAngle}, progress);
  if (!brep) return brep.error();
  result.brep = std::move(brep).value();
  return result;
}

Result<FieldResult> computeField(const TriangleMesh& input, const MeshOptions& options, Progress& progress) {
  if (const auto error = validateOptions(options)) return *error;
  auto inspected = inspectSurface(input, options.featureAngle, progress);
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
  auto inspected = inspectSurface(input, options.featureAngle, progress);
  if (!inspected) return inspected.error();
  MeshResult result;
  result.input = std::move(inspected).value();
  const TriangleMesh& mesh = result.input.repaired.mesh;
  const Brep& brep = result.input.brep;
  auto preparation = prepareFaces(mesh, brep, withDefaults(options), progress);
  if (!preparation) return preparation.error();
  const PreparedFaces& prepared = preparation.value();
  result.size = prepared.size.base;
  for (const CrossField& field : prepared.fields) {
    result.fieldSingularities += static_cast<std::int64_t>(field.singularities.size());
  }

  std::vector<MeshedFace> faces;
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    auto face = meshFace(mesh, brep, prepared, static_cast<std::int32_t>(f), options, progress);
    if (!face) return face.error();
    result.faces.push_back(face.value().report);
    faces.push_back(std::move(face).value());
  }
  result.mesh = joinFaces(brep, prepared, faces);
  if (!progress.report(Stage::quality, 0.0)) return cancelledError();
  QualityOptions quality;
  quality.featureAngle = options.featureAngle;
  quality.size = result.size;
  result.quality = measureQuality(result.mesh, &mesh, quality);
  return result;
}

}  // namespace qmcf
