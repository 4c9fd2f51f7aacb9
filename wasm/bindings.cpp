// The core as JavaScript sees it: plain objects and typed arrays in, plain objects and typed arrays out. Every array
// that is returned is a copy outside the WebAssembly heap. A call returns {error} or {value}.

#include <emscripten.h>
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "qmcf/base/math.hpp"
#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/field/even_streamlines.hpp"
#include "qmcf/io/read.hpp"
#include "qmcf/io/write.hpp"
#include "qmcf/pipeline/mesh_surface.hpp"
#include "qmcf/pipeline/report_json.hpp"
#include "qmcf/quality/quality.hpp"

// A direct import, since it is called from inner loops: the worker's onReport(stage, fraction) says whether to go on.
EM_JS(int, qmcfReport, (int stage, double fraction), { return Module.onReport(stage, fraction) ? 1 : 0; });

// Ends the instance with a message that the worker tells from other traps.
EM_JS(void, qmcfOutOfMemory, (), { abort("OOM"); });

namespace qmcf {
namespace {

using emscripten::val;

class HostProgress final : public Progress {
 public:
  [[nodiscard]] bool report(Stage stage, double fraction) override {
    return qmcfReport(static_cast<int>(stage), fraction) != 0;
  }
};

val text(std::string_view s) { return val(std::string(s)); }

val failure(const Error& error) {
  val elements = val::array();
  for (const std::int64_t id : error.elements) {
    elements.call<void>("push", static_cast<double>(id));
  }
  val details = val::object();
  details.set("code", text(errorName(error.code)));
  details.set("message", text(error.message));
  details.set("elements", elements);
  val out = val::object();
  out.set("error", details);
  return out;
}

val success(const val& value) {
  val out = val::object();
  out.set("value", value);
  return out;
}

/// A JavaScript typed array with a copy of `count` numbers.
template <class T>
val copyOut(const T* data, std::size_t count) {
  return val(emscripten::typed_memory_view(count, data)).call<val>("slice");
}
template <class T>
val copyOut(const std::vector<T>& values) {
  return copyOut(values.data(), values.size());
}
val copyOut(const std::vector<Vec3>& points) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return copyOut(points.empty() ? nullptr : &points.front().x, 3 * points.size());
}
template <std::size_t N>
val copyOut(const std::vector<std::array<std::int32_t, N>>& tuples) {
  return copyOut(tuples.empty() ? nullptr : tuples.front().data(), N * tuples.size());
}

std::size_t lengthOf(const val& array) { return array["length"].as<std::size_t>(); }

/// Fills `data`, room for as many numbers as the typed array has, with the array's numbers converted to T.
template <class T>
void copyIn(const val& array, T* data) {
  val(emscripten::typed_memory_view(lengthOf(array), data)).call<void>("set", array);
}

bool isNumber(const val& v) { return v.typeOf().as<std::string>() == "number"; }

Error wrongOption(std::string_view name, std::string_view expected) {
  return {ErrorCode::invalidOption, "The option " + std::string(name) + " must be " + std::string(expected) + ".", {}};
}

std::optional<Error> assign(double& option, std::string_view name, const val& given) {
  if (!isNumber(given)) {
    return wrongOption(name, "a number");
  }
  option = given.as<double>();
  return std::nullopt;
}

std::optional<Error> assign(std::optional<double>& option, std::string_view name, const val& given) {
  return assign(option.emplace(), name, given);
}

std::optional<Error> assign(std::optional<std::int64_t>& option, std::string_view name, const val& given) {
  constexpr double kLargestInteger = 9007199254740992.0;
  const double number = isNumber(given) ? given.as<double>() : 0.5;
  if (number != std::floor(number) || std::fabs(number) > kLargestInteger) {
    return wrongOption(name, "a whole number");
  }
  option = static_cast<std::int64_t>(number);
  return std::nullopt;
}

std::optional<Error> assign(std::vector<double>& option, std::string_view name, const val& given) {
  const bool isTyped = given.instanceof (val::global("Float64Array")) || given.instanceof (val::global("Float32Array"));
  if (!isTyped && !given.isArray()) {
    return wrongOption(name, "a Float64Array, a Float32Array or an array of numbers");
  }
  // What is no number becomes NaN, which is no size.
  const val numbers = val::global("Float64Array").call<val>("from", given);
  option.resize(lengthOf(numbers));
  if (!option.empty()) {
    copyIn(numbers, option.data());
  }
  return std::nullopt;
}

std::optional<Error> assign(bool& option, std::string_view name, const val& given) {
  if (!given.isTrue() && !given.isFalse()) {
    return wrongOption(name, "true or false");
  }
  option = given.isTrue();
  return std::nullopt;
}

std::optional<Error> assign(std::optional<bool>& option, std::string_view name, const val& given) {
  return assign(option.emplace(), name, given);
}

std::optional<Error> assign(Mode& option, std::string_view name, const val& given) {
  const std::string word = given.isString() ? given.as<std::string>() : std::string();
  if (word != "qmcf" && word != "qmorph") {
    return wrongOption(name, "\"qmcf\" or \"qmorph\"");
  }
  option = word == "qmcf" ? Mode::qmcf : Mode::qmorph;
  return std::nullopt;
}

bool assign(Vec3& point, const val& given) {
  if (!given.isArray() || lengthOf(given) != 3) {
    return false;
  }
  const std::array<double*, 3> coordinates = {&point.x, &point.y, &point.z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!isNumber(given[i])) {
      return false;
    }
    *coordinates[i] = given[i].as<double>();
  }
  return true;
}

std::optional<Error> assign(std::vector<FieldStroke>& option, std::string_view name, const val& given) {
  const Error wrong = wrongOption(name, "an array of {from: [x, y, z], to: [x, y, z]}");
  if (!given.isArray()) {
    return wrong;
  }
  option.clear();
  for (std::size_t i = 0; i < lengthOf(given); ++i) {
    const val stroke = given[i];
    const bool isObject = stroke.typeOf().as<std::string>() == "object" && !stroke.isNull();
    FieldStroke& next = option.emplace_back();
    if (!isObject || !assign(next.from, stroke["from"]) || !assign(next.to, stroke["to"])) {
      return wrong;
    }
  }
  return std::nullopt;
}

/// Calls visit(name, field) for every option. The structured binding fails to compile when MeshOptions gains a field.
template <class Visit>
void forEachOption(MeshOptions& options, Visit visit) {
  auto& [size, quads, sizes, curvature, fitSizes, featureAngle, mode, allQuad, repair, gradation, alignBoundary,
         alignSharp, alignNonManifold, alignCurvature, strokes, threads, trace] = options;
  visit("size", size);
  visit("quads", quads);
  visit("sizes", sizes);
  visit("curvature", curvature);
  visit("fitSizes", fitSizes);
  visit("featureAngle", featureAngle);
  visit("mode", mode);
  visit("allQuad", allQuad);
  visit("repair", repair);
  visit("gradation", gradation);
  visit("alignBoundary", alignBoundary);
  visit("alignSharp", alignSharp);
  visit("alignNonManifold", alignNonManifold);
  visit("alignCurvature", alignCurvature);
  visit("strokes", strokes);
  visit("threads", threads);
  visit("trace", trace);
}

/// The error for a key that is no option's name, if there is one.
std::optional<Error> findUnknownOption(const val& given) {
  const val keys = val::global("Object").call<val>("keys", given);
  for (std::size_t i = 0; i < lengthOf(keys); ++i) {
    const std::string key = keys[i].as<std::string>();
    bool known = false;
    MeshOptions options;
    forEachOption(options, [&](std::string_view name, const auto& /*option*/) { known = known || name == key; });
    if (!known) {
      return Error{ErrorCode::invalidOption, "There is no option with the name " + key + ".", {}};
    }
  }
  return std::nullopt;
}

/// Options that are absent or undefined keep their defaults.
Result<MeshOptions> toOptions(const val& given) {
  MeshOptions options;
  std::optional<Error> error = findUnknownOption(given);
  forEachOption(options, [&](const char* name, auto& option) {
    const val value = given[name];
    if (!error && !value.isUndefined()) {
      error = assign(option, name, value);
    }
  });
  if (!error) {
    error = validateOptions(options);
  }
  if (error) {
    return *std::move(error);
  }
  return options;
}

/// A mesh, and per vertex of it the vertex of the file or buffers that it is.
struct InputMesh {
  TriangleMesh mesh;
  std::vector<std::int32_t> vertices;
};

/// The mesh of {positions, triangles} or of {bytes}, a file's content.
Result<InputMesh> toInputMesh(const val& input, Progress& progress) {
  if (!input["bytes"].isUndefined()) {
    std::vector<std::byte> bytes(lengthOf(input["bytes"]));
    copyIn(input["bytes"], reinterpret_cast<std::uint8_t*>(bytes.data()));
    Result<ReadModel> model = readModel(bytes, progress);
    if (!model) {
      return model.error();
    }
    std::vector<std::int32_t> vertices = fileVertices(model.value());
    return InputMesh{std::move(model).value().mesh, std::move(vertices)};
  }
  const std::size_t coordinates = lengthOf(input["positions"]);
  const std::size_t corners = lengthOf(input["triangles"]);
  if (coordinates % 3 != 0 || corners % 3 != 0) {
    return Error{ErrorCode::malformedInput, "The lengths of positions and triangles must be multiples of 3.", {}};
  }
  TriangleMesh mesh;
  mesh.positions.resize(coordinates / 3);
  mesh.triangles.resize(corners / 3);
  if (mesh.positions.empty() || mesh.triangles.empty()) {
    return Error{ErrorCode::emptyInput, "There are no triangles in the buffers.", {}};
  }
  copyIn(input["positions"], &mesh.positions.front().x);
  copyIn(input["triangles"], mesh.triangles.front().data());
  std::vector<std::int32_t> vertices(mesh.positions.size());
  std::iota(vertices.begin(), vertices.end(), 0);
  return InputMesh{std::move(mesh), std::move(vertices)};
}

/// From one for each vertex of the file or buffers to one for each vertex as read.
std::optional<Error> spreadSizes(MeshOptions& options, const std::vector<std::int32_t>& vertices) {
  if (options.sizes.empty()) {
    return std::nullopt;
  }
  const auto count = static_cast<std::size_t>(*std::max_element(vertices.begin(), vertices.end())) + 1;
  if (options.sizes.size() != count) {
    return Error{ErrorCode::invalidOption,
                 "The option sizes must have one number for each of the model's " + std::to_string(count) +
                     " vertices, not " + std::to_string(options.sizes.size()) + ".",
                 {}};
  }
  const std::vector<double> sizes = std::exchange(options.sizes, {});
  for (const std::int32_t v : vertices) {
    options.sizes.push_back(sizes[static_cast<std::size_t>(v)]);
  }
  return std::nullopt;
}

val faceNames(const Brep& brep) {
  val names = val::array();
  for (const BrepFace& face : brep.faces) {
    names.call<void>("push", face.name);
  }
  return names;
}

val partValue(const InspectResult& result) {
  const TriangleMesh& mesh = result.repaired.mesh;
  val out = val::object();
  out.set("positions", copyOut(mesh.positions));
  out.set("triangles", copyOut(mesh.triangles));
  out.set("triangleFace", copyOut(result.brep.triangleFace));
  std::vector<std::int32_t> points;
  std::vector<std::int32_t> offsets{0};
  val kinds = val::array();
  for (const BrepEdge& edge : result.brep.edges) {
    points.insert(points.end(), edge.points.begin(), edge.points.end());
    offsets.push_back(static_cast<std::int32_t>(points.size()));
    kinds.call<void>("push", text(edgeKindName(edge.kind)));
  }
  out.set("edgePoints", copyOut(points));
  out.set("edgeOffsets", copyOut(offsets));
  out.set("edgeKinds", kinds);
  out.set("faceNames", faceNames(result.brep));
  out.set("report", toJson(result));
  return out;
}

/// The crosses and singularities of all patches, one after the other.
struct FlatField {
  std::vector<Vec3> points;
  std::vector<Vec3> directions;
  std::vector<Vec3> normals;
  std::vector<double> sizes;
  std::vector<std::uint8_t> constrained;
  std::vector<std::uint8_t> removed;
  std::vector<std::int32_t> faces;
  std::vector<Vec3> singularPoints;
  std::vector<Vec3> singularNormals;
  std::vector<std::int32_t> singularIndices;
  std::vector<std::int32_t> singularFaces;
  std::vector<Vec3> linePoints;
  std::vector<std::int32_t> lineOffsets{0};
};

/// The distance of streamlines in a picture: an element, or so much that about this many fit across all faces.
double streamlineSpacing(const FieldResult& result) {
  constexpr double kLinesSquared = 5000.0;
  double area = 0.0;
  for (const BrepFace& face : result.input.brep.faces) area += face.area;
  return std::fmax(result.size, std::sqrt(area / kLinesSquared));
}

void appendLines(FlatField& flat, const Patch& patch, const CrossField& field, double spacing) {
  for (const std::vector<Vec3>& line : evenStreamlines(patch, field, spacing)) {
    flat.linePoints.insert(flat.linePoints.end(), line.begin(), line.end());
    flat.lineOffsets.push_back(static_cast<std::int32_t>(flat.linePoints.size()));
  }
}

void append(FlatField& flat, const Patch& patch, const CrossField& field) {
  for (const VertexId v : patch.surface.vertices()) {
    const double angle = 0.25 * math::arg(field.cross[v]);
    const TangentFrame& frame = field.frame[v];
    flat.points.push_back(patch.surface.position(v));
    flat.directions.push_back(frame.x * math::cos(angle) + frame.y * math::sin(angle));
    flat.normals.push_back(frame.normal);
    flat.sizes.push_back(patch.size[v]);
    flat.constrained.push_back(static_cast<std::uint8_t>(field.constrained[v]));
    flat.removed.push_back(field.removed[v]);
    flat.faces.push_back(patch.face);
  }
  for (const Singularity& singularity : field.singularities) {
    flat.singularPoints.push_back(positionOf(patch.surface, singularity.point));
    flat.singularNormals.push_back(normalized(patch.surface.areaVector(singularity.point.triangle)));
    flat.singularIndices.push_back(singularity.index);
    flat.singularFaces.push_back(patch.face);
  }
}

val fieldValue(const FieldResult& result) {
  FlatField flat;
  const double spacing = streamlineSpacing(result);
  for (std::size_t i = 0; i < result.patches.size(); ++i) {
    append(flat, result.patches[i], result.fields[i]);
    appendLines(flat, result.patches[i], result.fields[i], spacing);
  }
  val crosses = val::object();
  crosses.set("positions", copyOut(flat.points));
  crosses.set("directions", copyOut(flat.directions));
  crosses.set("normals", copyOut(flat.normals));
  crosses.set("sizes", copyOut(flat.sizes));
  crosses.set("constrained", copyOut(flat.constrained));
  crosses.set("removed", copyOut(flat.removed));
  crosses.set("faces", copyOut(flat.faces));
  val singularities = val::object();
  singularities.set("positions", copyOut(flat.singularPoints));
  singularities.set("normals", copyOut(flat.singularNormals));
  singularities.set("indices", copyOut(flat.singularIndices));
  singularities.set("faces", copyOut(flat.singularFaces));
  val streamlines = val::object();
  streamlines.set("positions", copyOut(flat.linePoints));
  streamlines.set("offsets", copyOut(flat.lineOffsets));
  val out = val::object();
  out.set("size", result.size);
  out.set("crosses", crosses);
  out.set("singularities", singularities);
  out.set("streamlines", streamlines);
  return out;
}

/// Per element: the scaled Jacobian that the report's distribution is made of.
std::vector<double> scaledJacobians(const QuadMesh& mesh) {
  std::vector<double> values;
  values.reserve(mesh.elements.size());
  const auto at = [&](std::int32_t v) -> const Vec3& { return mesh.positions[static_cast<std::size_t>(v)]; };
  for (const Element& e : mesh.elements) {
    values.push_back(cornerCount(e) == 3 ? triangleScaledJacobian(at(e[0]), at(e[1]), at(e[2]))
                                         : quadScaledJacobian(at(e[0]), at(e[1]), at(e[2]), at(e[3])));
  }
  return values;
}

val meshValue(const MeshResult& result) {
  static_assert(sizeof(FeatureSegment) == 3 * sizeof(std::int32_t));
  const std::vector<FeatureSegment>& segments = result.mesh.featureSegments;
  val out = val::object();
  out.set("size", result.size);
  out.set("positions", copyOut(result.mesh.positions));
  out.set("elements", copyOut(result.mesh.elements));
  out.set("elementFace", copyOut(result.mesh.elementFace));
  out.set("featureSegments", copyOut(segments.empty() ? nullptr : &segments.front().a, 3 * segments.size()));
  out.set("elementScaledJacobian", copyOut(scaledJacobians(result.mesh)));
  out.set("faceNames", faceNames(result.input.brep));
  out.set("report", toJson(result));
  if (result.trace) out.set("trace", traceJson(result));
  return out;
}

/// Reads input and options and hands them to `stage`, a function of (TriangleMesh, MeshOptions, Progress).
template <class Stage, class ToValue>
val run(const val& input, const val& options, Stage stage, ToValue toValue) {
  HostProgress progress;
  Result<MeshOptions> parsed = toOptions(options);
  if (!parsed) {
    return failure(parsed.error());
  }
  const Result<InputMesh> read = toInputMesh(input, progress);
  if (!read) {
    return failure(read.error());
  }
  if (const auto error = spreadSizes(parsed.value(), read.value().vertices)) {
    return failure(*error);
  }
  const auto result = stage(read.value().mesh, parsed.value(), progress);
  return result ? success(toValue(result.value())) : failure(result.error());
}

val inspectModel(const val& input, const val& options) {
  const auto inspect = [](const TriangleMesh& mesh, const MeshOptions& o, Progress& progress) {
    return inspectSurface(mesh, o, progress);
  };
  return run(input, options, inspect, partValue);
}

val fieldModel(const val& input, const val& options) { return run(input, options, computeField, fieldValue); }

val meshModel(const val& input, const val& options) { return run(input, options, meshSurface, meshValue); }

/// The arrays of an earlier result, or of anybody else's making.
Result<QuadMesh> toQuadMesh(const val& input, std::size_t faceNames) {
  const std::size_t coordinates = lengthOf(input["positions"]);
  const std::size_t corners = lengthOf(input["elements"]);
  const std::size_t segments = lengthOf(input["featureSegments"]);
  if (coordinates % 3 != 0 || corners % 4 != 0 || segments % 3 != 0) {
    return Error{ErrorCode::malformedInput,
                 "The lengths of positions and featureSegments must be multiples of 3, that of elements one of 4.",
                 {}};
  }
  QuadMesh mesh;
  mesh.positions.resize(coordinates / 3);
  mesh.elements.resize(corners / 4);
  mesh.elementFace.resize(lengthOf(input["elementFace"]));
  mesh.featureSegments.resize(segments / 3);
  if (mesh.positions.empty() || mesh.elements.empty()) {
    return Error{ErrorCode::emptyInput, "There are no elements to write.", {}};
  }
  if (mesh.elementFace.size() != mesh.elements.size()) {
    return Error{ErrorCode::malformedInput,
                 "elementFace must have one number for each of the " + std::to_string(mesh.elements.size()) +
                     " elements, not " + std::to_string(mesh.elementFace.size()) + ".",
                 {}};
  }
  copyIn(input["positions"], &mesh.positions.front().x);
  copyIn(input["elements"], mesh.elements.front().data());
  copyIn(input["elementFace"], mesh.elementFace.data());
  if (!mesh.featureSegments.empty()) {
    copyIn(input["featureSegments"], &mesh.featureSegments.front().a);
  }
  const auto isVertex = [&](std::int32_t v) { return v >= 0 && static_cast<std::size_t>(v) < mesh.positions.size(); };
  const std::size_t faces = std::max(faceNames, mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Element& element = mesh.elements[e];
    const std::int32_t face = mesh.elementFace[e];
    if (!std::all_of(element.begin(), element.begin() + cornerCount(element), isVertex) || face < 0 ||
        static_cast<std::size_t>(face) >= faces) {
      return Error{ErrorCode::indexOutOfRange,
                   "Element " + std::to_string(e) + " names a vertex or a face that there is not.",
                   {}};
    }
  }
  for (std::size_t s = 0; s < mesh.featureSegments.size(); ++s) {
    const FeatureSegment& segment = mesh.featureSegments[s];
    if (!isVertex(segment.a) || !isVertex(segment.b)) {
      return Error{ErrorCode::indexOutOfRange,
                   "Feature segment " + std::to_string(s) + " names a vertex that there is not.",
                   {}};
    }
  }
  return mesh;
}

/// The bytes of a file of the given extension from the arrays of a mesh.
val writeModel(const val& input, const std::string& extension) {
  const std::optional<OutputFormat> format = outputFormatOf("mesh." + extension);
  if (!format) {
    return failure({ErrorCode::unsupportedOutput, "Files of the type \"" + extension + "\" can't be written.", {}});
  }
  WriteOptions options;
  const val names = input["faceNames"];
  for (std::size_t i = 0; i < lengthOf(names); ++i) {
    options.faceNames.push_back(names[i].as<std::string>());
  }
  const Result<QuadMesh> mesh = toQuadMesh(input, options.faceNames.size());
  if (!mesh) {
    return failure(mesh.error());
  }
  const std::string content = writeMesh(mesh.value(), *format, options);
  return success(copyOut(reinterpret_cast<const std::uint8_t*>(content.data()), content.size()));
}

/// The names that both languages must agree on: {errors, stages, options}.
val tables() {
  val errors = val::array();
#define QMCF_ERROR(code, exitStatus, meaning) errors.call<void>("push", text(errorName(ErrorCode::code)));
#include "qmcf/base/errors.def"
#undef QMCF_ERROR
  val stages = val::array();
  for (int i = 0; i <= static_cast<int>(Stage::write); ++i) {
    stages.call<void>("push", text(stageName(static_cast<Stage>(i))));
  }
  val names = val::array();
  MeshOptions options;
  forEachOption(options, [&](const char* name, auto& /*option*/) { names.call<void>("push", text(name)); });
  val out = val::object();
  out.set("errors", errors);
  out.set("stages", stages);
  out.set("options", names);
  return out;
}

EMSCRIPTEN_BINDINGS(qmcf) {
  std::set_new_handler(&qmcfOutOfMemory);
  emscripten::function("inspect", &inspectModel);
  emscripten::function("field", &fieldModel);
  emscripten::function("mesh", &meshModel);
  emscripten::function("write", &writeModel);
  emscripten::function("tables", &tables);
}

}  // namespace
}  // namespace qmcf
