#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "exit_status.hpp"
#include "load.hpp"
#include "qmcf/pipeline/report_json.hpp"
#include "report_text.hpp"

namespace qmcf::cli {
namespace {

using Json = nlohmann::ordered_json;

/// What the file holds, then the fields of the InspectResult's report.
std::string infoJson(const ReadModel& model, const InspectResult& result) {
  Json json = {{"format", inputFormatName(model.format)},
               {"vertices", model.mesh.positions.size()},
               {"polygons", model.polygons},
               {"skippedFaces", model.skippedFaces},
               {"triangles", model.mesh.triangles.size()},
               {"labels", model.mesh.labelNames}};
  Json info = {{"input", json}};
  info.update(Json::parse(toJson(result)));
  return info.dump() + "\n";
}

}  // namespace

int run(const InfoCommand& command) {
  MeshOptions options;
  options.featureAngle = command.featureAngle;
  if (const std::optional<Error> error = validateOptions(options)) return fail(*error);
  ConsoleProgress progress(command.json);
  const Result<ReadModel> model = loadModel(command.input, progress);
  progress.clear();
  if (!model.ok()) return fail(model.error(), command.input);
  const Result<InspectResult> result = inspectSurface(model.value().mesh, command.featureAngle, progress);
  progress.clear();
  if (!result.ok()) return fail(result.error(), command.input);
  const std::string text = command.json ? infoJson(model.value(), result.value())
                                        : modelText(command.input, model.value()) + partText(result.value()) +
                                              elementsText(result.value().brep);
  std::fputs(text.c_str(), stdout);
  return kDone;
}

}  // namespace qmcf::cli
