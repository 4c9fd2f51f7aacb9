#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "commands.hpp"
#include "console.hpp"
#include "exit_status.hpp"
#include "files.hpp"
#include "load.hpp"
#include "qmcf/io/write.hpp"
#include "qmcf/pipeline/report_json.hpp"
#include "report_text.hpp"
#include "sizing_file.hpp"
#include "stage_clock.hpp"

namespace qmcf::cli {
namespace {

Error unknownFormat(const std::string& file) {
  return {ErrorCode::unsupportedOutput,
          file + " has no known extension; use .obj, .ply, .stl, .vtu, .msh, .inp, .bdf or .nas.",
          {}};
}

/// An error that is known before anything has been read.
std::optional<Error> checkCommand(const MeshCommand& command) {
  if (!outputFormatOf(command.output)) return unknownFormat(command.output);
  if (std::optional<Error> error = validateOptions(command.options)) return error;
  if (std::optional<Error> error = checkWritable(command.output)) return error;
  if (!command.sizingMesh.empty() && !outputFormatOf(command.sizingMesh)) return unknownFormat(command.sizingMesh);
  for (const std::string& file : {command.report, command.trace, command.sizingOut, command.sizingMesh}) {
    if (std::optional<Error> error = file.empty() ? std::nullopt : checkWritable(file)) return error;
  }
  return std::nullopt;
}

WriteOptions groupNames(const Brep& brep) {
  WriteOptions options;
  for (const BrepFace& face : brep.faces) options.faceNames.push_back(face.name);
  return options;
}

/// The report with indentation: people look into it, too. It ends with the CPU seconds of each stage.
std::string reportFile(const MeshResult& result, StageClock& clock) {
  auto report = nlohmann::ordered_json::parse(toJson(result));
  const auto seconds = clock.seconds();
  for (std::size_t s = 0; s < seconds.size(); ++s) {
    report["seconds"][std::string(stageName(static_cast<Stage>(s)))] = seconds[s];
  }
  return report.dump(1) + "\n";
}

}  // namespace

int run(const MeshCommand& command) {
  const auto start = std::chrono::steady_clock::now();
  if (const std::optional<Error> error = checkCommand(command)) return fail(*error);
  ConsoleProgress console(command.quiet);
  StageClock progress(console);
  const Result<ReadModel> model = loadModel(command.input, progress);
  console.clear();
  if (!model.ok()) return fail(model.error(), command.input);
  MeshOptions options = command.options;
  options.trace = !command.trace.empty();
  if (!command.sizing.empty()) {
    Result<std::vector<double>> sizes = spreadSizing(options.sizes, model.value());
    if (!sizes.ok()) return fail(sizes.error(), command.sizing);
    options.sizes = std::move(sizes).value();
  }
  SizingMesh sizing;
  const bool wantsSizing = !command.sizingMesh.empty();
  const TriangleMesh& triangles = model.value().mesh;
  const Result<MeshResult> result =
      wantsSizing ? meshWithSizing(triangles, options, progress, sizing) : meshSurface(triangles, options, progress);
  console.clear();
  if (!result.ok()) return fail(result.error(), command.input);

  const MeshResult& mesh = result.value();
  if (!progress.report(Stage::write, 0.0)) return fail(cancelledError(), command.input);
  const std::string content = writeMesh(mesh.mesh, *outputFormatOf(command.output), groupNames(mesh.input.brep));
  // A last look: a run that was interrupted this late leaves no file either.
  if (!progress.report(Stage::write, 1.0)) return fail(cancelledError(), command.input);
  console.clear();
  if (const std::optional<Error> error = writeFile(command.output, content)) return fail(*error);
  if (!command.report.empty()) {
    if (const std::optional<Error> error = writeFile(command.report, reportFile(mesh, progress))) return fail(*error);
  }
  if (!command.trace.empty()) {
    if (const std::optional<Error> error = writeFile(command.trace, traceJson(mesh))) return fail(*error);
  }
  if (!command.sizingOut.empty()) {
    const std::string sizes = wantsSizing ? sizingText(sizing.size) : sizingText(model.value(), mesh.vertexSize);
    if (const std::optional<Error> error = writeFile(command.sizingOut, sizes)) return fail(*error);
  }
  if (wantsSizing) {
    const std::string text = writeMesh(sizing.triangles, *outputFormatOf(command.sizingMesh));
    if (const std::optional<Error> error = writeFile(command.sizingMesh, text)) return fail(*error);
  }
  if (!mesh.quality.valid) warn("the mesh is not valid: see the checks in the report.", command.output);
  if (command.quiet) return kDone;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  const std::string text = modelText(command.input, model.value()) + partText(mesh.input) + meshText(mesh) +
                           qualityText(mesh.quality, hasCreases(mesh.input.brep)) + "Written   " + command.output +
                           " in " + shortNumber(elapsed.count()) + " s\n";
  std::fputs(text.c_str(), stdout);
  return kDone;
}

}  // namespace qmcf::cli
