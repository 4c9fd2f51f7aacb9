// field_study MODEL [--quads N] [--draw FILE] [VARIANT ...]
// The cross field of a model under one or more sets of options, as figures (JSON, to standard output) and, of the last
// variant, as a drawing (JSON, to FILE). A variant is a list like solver=leastSquares,diffuse=0 of FieldOptions' names;
// "default" changes nothing. Exit status: 0 done, 2 wrong usage, 3 the model can't be used.
#include <charconv>
#include <ctime>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>

#include "qmcf/field/even_streamlines.hpp"
#include "qmcf/io/read.hpp"
#include "qmcf/pipeline/mesh_surface.hpp"
#include "study_measures.hpp"

namespace qmcf {
namespace {

using Json = nlohmann::ordered_json;

double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

bool assign(FieldOptions& options, const std::string& name, const std::string& value) {
  const bool on = value != "0";
  if (name == "solver") {
    options.solver = value == "leastSquares" ? FieldSolver::leastSquares : FieldSolver::eliminate;
    return value == "leastSquares" || value == "eliminate";
  }
  if (name == "energy") {
    options.energy = value == "finiteElements" ? FieldEnergy::finiteElements : FieldEnergy::cotangent;
    return value == "finiteElements" || value == "cotangent";
  }
  const std::pair<const char*, bool*> switches[] = {{"boundary", &options.boundary},
                                                    {"sharp", &options.sharp},
                                                    {"nonManifold", &options.nonManifold},
                                                    {"curvature", &options.curvature},
                                                    {"mask", &options.mask},
                                                    {"pinCurvature", &options.pinCurvature},
                                                    {"diffuse", &options.diffuse},
                                                    {"removeInconsistent", &options.removeInconsistent}};
  for (const auto& [key, field] : switches) {
    if (name != key) continue;
    *field = on;
    return true;
  }
  const std::pair<const char*, double*> numbers[] = {{"smoothness", &options.smoothness},
                                                     {"shift", &options.shift},
                                                     {"guidance", &options.guidance},
                                                     {"pinAnisotropy", &options.pinAnisotropy},
                                                     {"pinTurn", &options.pinTurn},
                                                     {"denseBoundary", &options.denseBoundary},
                                                     {"diffusionLength", &options.diffusionLength},
                                                     {"cancelDistance", &options.cancelDistance}};
  for (const auto& [key, field] : numbers) {
    if (name != key) continue;
    *field = std::strtod(value.c_str(), nullptr);
    return true;
  }
  return false;
}

std::optional<FieldOptions> parseVariant(const std::string& text) {
  FieldOptions options;
  if (text == "default") return options;
  std::istringstream list(text);
  for (std::string item; std::getline(list, item, ',');) {
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos || !assign(options, item.substr(0, equals), item.substr(equals + 1))) {
      return std::nullopt;
    }
  }
  return options;
}

struct Run {
  std::vector<CrossField> fields;
  double seconds = 0.0;
};

Result<Run> solveAll(const FieldResult& part, const FieldOptions& options) {
  std::vector<std::uint8_t> kinds;
  for (const BrepEdge& edge : part.input.brep.edges) kinds.push_back(static_cast<std::uint8_t>(edge.kind));
  Run run;
  const double start = cpuSeconds();
  for (const Patch& patch : part.patches) {
    SilentProgress progress;
    Result<CrossField> field = computeCrossField(patch, kinds, options, progress);
    if (!field) return field.error();
    run.fields.push_back(std::move(field).value());
  }
  run.seconds = cpuSeconds() - start;
  return run;
}

/// Where the principal directions are reliable, and which they are.
Result<Run> solveReliable(const FieldResult& part) {
  FieldOptions options;
  options.pinCurvature = true;
  options.removeInconsistent = false;
  options.denseBoundary = 0.0;
  options.diffuse = false;
  options.cancelDistance = 0.0;
  return solveAll(part, options);
}

Json figuresOf(const FieldResult& part, const Run& run, const Run& reliable) {
  FieldFigures figures;
  for (std::size_t i = 0; i < run.fields.size(); ++i) {
    figures.add(measureField(part.patches[i], run.fields[i], reliable.fields[i]));
  }
  return {{"seconds", run.seconds},
          {"vertices", figures.vertices},
          {"positive", figures.positive},
          {"negative", figures.negative},
          {"pairs", figures.pairs},
          {"nearBoundary", figures.nearBoundary},
          {"indexDefect", figures.indexDefect},
          {"notFinite", figures.notFinite},
          {"pinned", figures.pinned},
          {"removed", figures.removed},
          {"energy", figures.energy},
          {"boundaryDeviation", figures.boundaryDeviation},
          {"curvatureDeviation",
           figures.reliable > 0 ? Json(figures.curvatureDeviation / static_cast<double>(figures.reliable)) : Json()},
          {"reliable", figures.reliable}};
}

Json point(const Vec3& p) { return {p.x, p.y, p.z}; }

Json drawingOf(const FieldResult& part, const Run& run, double spacing) {
  Json drawing{{"size", part.size},
               {"patches", Json::array()},
               {"lines", Json::array()},
               {"singularities", Json::array()},
               {"edges", Json::array()}};
  for (std::size_t i = 0; i < run.fields.size(); ++i) {
    const Patch& patch = part.patches[i];
    const CrossField& field = run.fields[i];
    Json positions = Json::array();
    Json triangles = Json::array();
    Json pins = Json::array();
    Json removed = Json::array();
    for (const VertexId v : patch.surface.vertices()) {
      positions.push_back(point(patch.surface.position(v)));
      pins.push_back(static_cast<int>(field.constrained[v]));
      removed.push_back(field.removed[v]);
    }
    for (const TriangleId t : patch.surface.triangles()) {
      const auto [a, b, c] = patch.surface.corners(t);
      triangles.push_back({a.value, b.value, c.value});
    }
    for (const HalfedgeId h : patch.surface.halfedges()) {
      if (!patch.surface.isBoundary(h)) continue;
      drawing["edges"].push_back({point(patch.surface.position(patch.surface.origin(h))),
                                  point(patch.surface.position(patch.surface.target(h)))});
    }
    for (const std::vector<Vec3>& line : evenStreamlines(patch, field, spacing * part.size)) {
      Json points = Json::array();
      for (const Vec3& p : line) points.push_back(point(p));
      drawing["lines"].push_back(std::move(points));
    }
    for (const Singularity& s : field.singularities) {
      drawing["singularities"].push_back({{"point", point(positionOf(patch.surface, s.point))}, {"index", s.index}});
    }
    drawing["patches"].push_back({{"positions", std::move(positions)},
                                  {"triangles", std::move(triangles)},
                                  {"constrained", std::move(pins)},
                                  {"removed", std::move(removed)}});
  }
  return drawing;
}

int fail(int status, const std::string& message) {
  std::cerr << message << '\n';
  return status;
}

struct Command {
  std::string model;
  std::string draw;
  double spacing = 2.0;
  MeshOptions options;
  std::vector<std::string> variants;
};

std::optional<Command> parseCommand(std::span<char*> arguments) {
  Command command;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string argument = arguments[i];
    const bool hasValue = i + 1 < arguments.size();
    if (argument == "--quads" && hasValue) {
      command.options.quads = std::strtoll(arguments[++i], nullptr, 10);
    } else if (argument == "--draw" && hasValue) {
      command.draw = arguments[++i];
    } else if (argument == "--spacing" && hasValue) {
      command.spacing = std::strtod(arguments[++i], nullptr);
    } else if (command.model.empty()) {
      command.model = argument;
    } else {
      command.variants.push_back(argument);
    }
  }
  if (command.model.empty()) return std::nullopt;
  if (command.variants.empty()) command.variants.emplace_back("default");
  return command;
}

int study(const Command& command) {
  std::ifstream file(command.model, std::ios::binary);
  if (!file) return fail(2, command.model + " can't be read");
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  SilentProgress progress;
  const Result<ReadModel> model = readModel(std::as_bytes(std::span(content)), progress);
  if (!model) return fail(3, model.error().message);
  const Result<FieldResult> part = computeField(model.value().mesh, command.options, progress);
  if (!part) return fail(3, part.error().message);
  const Result<Run> reliable = solveReliable(part.value());
  if (!reliable) return fail(1, reliable.error().message);

  Json results = Json::array();
  for (const std::string& variant : command.variants) {
    const std::optional<FieldOptions> options = parseVariant(variant);
    if (!options) return fail(2, variant + " is no variant");
    const Result<Run> run = solveAll(part.value(), *options);
    if (!run) return fail(1, run.error().message);
    Json figures = figuresOf(part.value(), run.value(), reliable.value());
    figures["variant"] = variant;
    results.push_back(std::move(figures));
    if (!command.draw.empty() && variant == command.variants.back()) {
      std::ofstream(command.draw) << drawingOf(part.value(), run.value(), command.spacing);
    }
  }
  std::cout << Json{{"faces", part.value().patches.size()}, {"size", part.value().size}, {"results", results}} << '\n';
  return 0;
}

}  // namespace
}  // namespace qmcf

int main(int count, char** arguments) {
  const auto command = qmcf::parseCommand(std::span(arguments, static_cast<std::size_t>(count)).subspan(1));
  if (!command) {
    return qmcf::fail(2, "usage: field_study MODEL [--quads N] [--draw FILE] [--spacing ELEMENTS] [VARIANT ...]");
  }
  return qmcf::study(*command);
}
