#include <cstdio>

#include "commands.hpp"
#include "console.hpp"
#include "exit_status.hpp"
#include "files.hpp"
#include "load.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/io/vtu.hpp"
#include "qmcf/io/write.hpp"
#include "report_text.hpp"
#include "sizing_file.hpp"

namespace qmcf::cli {
namespace {

/// The arrays of the field's file, patch by patch; the points of singularities follow those of their patch.
struct FieldArrays {
  std::vector<double> direction;  ///< One of the four directions, a unit vector; zero at a singularity.
  std::vector<double> second;     ///< The direction a quarter turn on.
  std::vector<double> normal;
  std::vector<double> size;
  std::vector<double> magnitude;               ///< Before normalisation; 0 at a singularity.
  std::vector<std::int32_t> constrained;       ///< FieldPin as a number.
  std::vector<std::int32_t> removed;           ///< 1 where a pin to curvature was taken back.
  std::vector<std::int32_t> singularityIndex;  ///< Per cell: 0 for a triangle.
  std::vector<std::int32_t> face;              ///< Per cell.
};

void append(std::vector<double>& values, const Vec3& v) { values.insert(values.end(), {v.x, v.y, v.z}); }

void appendVertices(VtuGrid& grid, FieldArrays& arrays, const Patch& patch, const CrossField& field) {
  for (const VertexId v : patch.surface.vertices()) {
    const double angle = math::arg(field.cross[v]) / 4.0;
    const TangentFrame& frame = field.frame[v];
    const Vec3 direction = frame.x * math::cos(angle) + frame.y * math::sin(angle);
    grid.points.push_back(patch.surface.position(v));
    append(arrays.direction, direction);
    append(arrays.second, cross(frame.normal, direction));
    append(arrays.normal, frame.normal);
    arrays.size.push_back(patch.size[v]);
    arrays.magnitude.push_back(field.magnitude[v]);
    arrays.constrained.push_back(static_cast<std::int32_t>(field.constrained[v]));
    arrays.removed.push_back(field.removed[v]);
  }
}

void appendPatch(VtuGrid& grid, FieldArrays& arrays, const Patch& patch, const CrossField& field) {
  const auto first = static_cast<std::int32_t>(grid.points.size());
  appendVertices(grid, arrays, patch, field);
  for (const TriangleId t : patch.surface.triangles()) {
    for (const VertexId v : patch.surface.corners(t)) grid.connectivity.push_back(first + v.value);
    grid.cells.push_back(VtuCell::triangle);
    arrays.face.push_back(patch.face);
    arrays.singularityIndex.push_back(0);
  }
  for (const Singularity& singularity : field.singularities) {
    grid.connectivity.push_back(static_cast<std::int32_t>(grid.points.size()));
    grid.cells.push_back(VtuCell::vertex);
    grid.points.push_back(positionOf(patch.surface, singularity.point));
    append(arrays.direction, {});
    append(arrays.second, {});
    append(arrays.normal, normalized(patch.surface.areaVector(singularity.point.triangle)));
    double size = 0.0;
    const std::array<VertexId, 3> corners = patch.surface.corners(singularity.point.triangle);
    for (std::size_t c = 0; c < 3; ++c) size += singularity.point.barycentric[c] * patch.size[corners[c]];
    arrays.size.push_back(size);
    arrays.magnitude.push_back(0.0);
    arrays.constrained.push_back(0);
    arrays.removed.push_back(0);
    arrays.face.push_back(patch.face);
    arrays.singularityIndex.push_back(singularity.index);
  }
}

VtuGrid fieldGrid(const FieldResult& result) {
  VtuGrid grid;
  FieldArrays arrays;
  for (std::size_t i = 0; i < result.patches.size(); ++i)
    appendPatch(grid, arrays, result.patches[i], result.fields[i]);
  grid.pointData = {{"direction", 3, std::move(arrays.direction)}, {"secondDirection", 3, std::move(arrays.second)},
                    {"normal", 3, std::move(arrays.normal)},       {"size", 1, std::move(arrays.size)},
                    {"magnitude", 1, std::move(arrays.magnitude)}, {"constrained", 1, std::move(arrays.constrained)},
                    {"removed", 1, std::move(arrays.removed)}};
  grid.cellData = {{"face", 1, std::move(arrays.face)}, {"singularityIndex", 1, std::move(arrays.singularityIndex)}};
  VtuNames names{"faceNames", {}};
  for (const BrepFace& face : result.input.brep.faces) names.values.push_back(face.name);
  grid.names.push_back(std::move(names));
  return grid;
}

std::string fieldText(const FieldResult& result) {
  std::int64_t positive = 0;
  std::int64_t negative = 0;
  for (const CrossField& field : result.fields) {
    for (const Singularity& singularity : field.singularities) ++(singularity.index > 0 ? positive : negative);
  }
  return "Field     " + counted(positive + negative, "singularity", "singularities") + " (" + std::to_string(positive) +
         " positive, " + std::to_string(negative) + " negative), element size " + shortNumber(result.size) + "\n";
}

}  // namespace

int run(const FieldCommand& command) {
  if (outputFormatOf(command.output) != OutputFormat::vtu) {
    return fail(
        {ErrorCode::unsupportedOutput, "The cross field is written as .vtu only, not as " + command.output + ".", {}});
  }
  if (const std::optional<Error> error = validateOptions(command.options)) return fail(*error);
  if (const std::optional<Error> error = checkWritable(command.output)) return fail(*error);
  ConsoleProgress progress(command.quiet);
  const Result<ReadModel> model = loadModel(command.input, progress);
  progress.clear();
  if (!model.ok()) return fail(model.error(), command.input);
  MeshOptions options = command.options;
  if (!command.sizing.empty()) {
    Result<std::vector<double>> sizes = spreadSizing(options.sizes, model.value());
    if (!sizes.ok()) return fail(sizes.error(), command.sizing);
    options.sizes = std::move(sizes).value();
  }
  const Result<FieldResult> result = computeField(model.value().mesh, options, progress);
  progress.clear();
  if (!result.ok()) return fail(result.error(), command.input);
  if (const std::optional<Error> error = writeFile(command.output, writeVtu(fieldGrid(result.value()))))
    return fail(*error);
  if (command.quiet) return kDone;
  const std::string text = modelText(command.input, model.value()) + partText(result.value().input) +
                           fieldText(result.value()) + "Written   " + command.output + "\n";
  std::fputs(text.c_str(), stdout);
  return kDone;
}

}  // namespace qmcf::cli
