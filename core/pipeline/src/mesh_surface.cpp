// What may be asked of the pipeline. Bytes are read before and written after it.
#include "qmcf/pipeline/mesh_surface.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "mesh_run.hpp"
#include "prepare.hpp"

namespace qmcf {
namespace {

constexpr std::int64_t kDefaultQuads = 3000;
constexpr std::int64_t kMostQuads = 10'000'000;
constexpr std::int64_t kMostThreads = 256;

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
  if (options.threads && (*options.threads < 1 || *options.threads > kMostThreads)) {
    return invalid("threads must be between 1 and 256.");
  }
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
  return meshInspected(input, std::move(inspected).value(), withDefaults(options), progress);
}

}  // namespace qmcf
