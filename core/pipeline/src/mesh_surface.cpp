// What may be asked of the pipeline. Bytes are read before and written after it.
#include "qmcf/pipeline/mesh_surface.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "mesh_run.hpp"
#include "prepare.hpp"
#include "vertex_sizes.hpp"

namespace qmcf {
namespace {

constexpr std::int64_t kDefaultQuads = 3000;
constexpr std::int64_t kMostQuads = 10'000'000;
constexpr std::int64_t kMostThreads = 256;

Error invalid(std::string message) { return {ErrorCode::invalidOption, std::move(message), {}}; }

bool isLength(double x) { return std::isfinite(x) && x > 0.0; }

std::optional<Error> validateSizes(const MeshOptions& options) {
  if (options.size && options.quads) return invalid("Give either size or quads, not both.");
  if (options.size && !isLength(*options.size)) {
    return invalid("size must be a positive length in units of the model.");
  }
  if (options.quads && (*options.quads < 1 || *options.quads > kMostQuads)) {
    return invalid("quads must be between 1 and 10,000,000.");
  }
  if (options.curvature && !isLength(*options.curvature)) {
    return invalid("curvature must be a positive distance in units of the model.");
  }
  if (options.quads && !options.sizes.empty()) {
    return invalid(
        "Give either sizes or quads, not both: the sizes say how many elements there are. size may go with them.");
  }
  if (options.fitSizes.value_or(false) && options.mode != Mode::qmcf) {
    return invalid("Fitting sizes to the field needs the mode qmcf: the other one asks no cross field.");
  }
  if (options.fitSizes.value_or(false) && !options.sizes.empty() && !options.size) {
    return invalid(
        "Fitting sizes to the field goes with size or quads, not with sizes alone: these say what they are "
        "themselves.");
  }
  for (std::size_t i = 0; i < options.sizes.size(); ++i) {
    if (isLength(options.sizes[i])) continue;
    return Error{ErrorCode::invalidOption,
                 "sizes[" + std::to_string(i) + "] must be a positive length in units of the model.",
                 {static_cast<std::int64_t>(i)}};
  }
  return std::nullopt;
}

/// The options of a run on an inspected part: with defaults, and with sizes at the vertices of the repaired mesh.
Result<MeshOptions> optionsFor(const TriangleMesh& input, const InspectResult& inspected, MeshOptions options) {
  if (options.sizes.empty()) {
    if (!options.size && !options.quads) options.quads = kDefaultQuads;
    if (!options.fitSizes) options.fitSizes = options.quads && options.mode == Mode::qmcf;
    return options;
  }
  auto sizes = sizesOfRepaired(options.sizes, input, inspected.repaired.mesh);
  if (!sizes) return sizes.error();
  options.sizes = std::move(sizes).value();
  return options;
}

}  // namespace

std::string_view modeName(Mode mode) { return mode == Mode::qmcf ? "qmcf" : "qmorph"; }

std::optional<Error> validateOptions(const MeshOptions& options) {
  if (auto error = validateSizes(options)) return error;
  if (!(options.featureAngle > 0.0 && options.featureAngle < 180.0)) {
    return invalid("featureAngle must be between 0 and 180 degrees.");
  }
  if (!(options.gradation > 0.0 && options.gradation <= 1.0))
    return invalid("gradation must be above 0 and at most 1.");
  if (options.threads && (*options.threads < 1 || *options.threads > kMostThreads)) {
    return invalid("threads must be between 1 and 256.");
  }
  for (std::size_t i = 0; i < options.strokes.size(); ++i) {
    const double length = norm(options.strokes[i].to - options.strokes[i].from);  // NaN or infinite if a coordinate is.
    if (length > 0.0 && std::isfinite(length)) continue;
    return Error{ErrorCode::invalidOption,
                 "strokes[" + std::to_string(i) + "] must join two different points.",
                 {static_cast<std::int64_t>(i)}};
  }
  return std::nullopt;
}

Result<InspectResult> inspectSurface(const TriangleMesh& input, const MeshOptions& options, Progress& progress) {
  if (const auto error = validateOptions(options)) return *error;
  InspectResult result;
  auto repaired = repair(input, RepairOptions{options.repair}, progress);
  if (!repaired) return repaired.error();
  result.repaired = std::move(repaired).value();
  auto brep = recoverBrep(result.repaired.mesh, BrepOptions{options.featureAngle, result.repaired.flatEdges}, progress);
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
  auto own = optionsFor(input, result.input, options);
  if (!own) return own.error();
  own.value().mode = Mode::qmcf;  // The field is wanted whatever front would ask it.
  const RunOptions run{own.value(), Leftovers::stay};
  auto prepared =
      prepareFaces(result.input.repaired.mesh, result.input.brep, run, nullptr, settlingOf(run), {}, progress);
  if (!prepared) return prepared.error();
  result.size = prepared.value().size.base;
  result.patches = std::move(prepared.value().patches);
  result.fields = std::move(prepared.value().fields);
  return result;
}

namespace {

Result<MeshResult> meshWhole(const TriangleMesh& input, const MeshOptions& options, Progress& progress,
                             SizingMesh* sizing) {
  if (const auto error = validateOptions(options)) return *error;
  auto inspected = inspectSurface(input, options, progress);
  if (!inspected) return inspected.error();
  const auto own = optionsFor(input, inspected.value(), options);
  if (!own) return own.error();
  return meshInspected(input, std::move(inspected).value(), own.value(), progress, sizing);
}

}  // namespace

Result<MeshResult> meshSurface(const TriangleMesh& input, const MeshOptions& options, Progress& progress) {
  return meshWhole(input, options, progress, nullptr);
}

Result<MeshResult> meshWithSizing(const TriangleMesh& input, const MeshOptions& options, Progress& progress,
                                  SizingMesh& sizing) {
  return meshWhole(input, options, progress, &sizing);
}

}  // namespace qmcf
