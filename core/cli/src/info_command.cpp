#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "exit_status.hpp"
#include "load.hpp"
#include "qmcf/pipeline/report_json.hpp"
#include "qmcf/topology/statistics.hpp"
#include "report_text.hpp"

namespace qmcf::cli {
namespace {

using Json = nlohmann::ordered_json;

Json statisticsJson(const MeshStatistics& statistics) {
  return {{"vertices", statistics.vertices},
          {"unusedVertices", statistics.unusedVertices},
          {"triangles", statistics.triangles},
          {"diagonal", statistics.diagonal},
          {"degenerateTriangles", statistics.degenerateTriangles},
          {"sliverTriangles", statistics.sliverTriangles},
          {"duplicateVertices", statistics.duplicateVertices},
          {"duplicateTriangles", statistics.duplicateTriangles},
          {"components", statistics.components},
          {"boundaryEdges", statistics.boundaryEdges},
          {"boundaryLoops", statistics.boundaryLoops},
          {"eulerCharacteristic", statistics.eulerCharacteristic},
          {"nonManifoldEdges", statistics.nonManifoldEdges},
          {"nonManifoldVertices", statistics.nonManifoldVertices},
          {"misorientedEdges", statistics.misorientedEdges}};
}

/// What the file holds, its state before repair, then the fields of the InspectResult's report.
std::string infoJson(const ReadModel& model, const MeshStatistics& statistics, const InspectResult& result) {
  Json json = {{"format", inputFormatName(model.format)},
               {"vertices", model.mesh.positions.size()},
               {"polygons", model.polygons},
               {"skippedFaces", model.skippedFaces},
               {"triangles", model.mesh.triangles.size()},
               {"labels", model.mesh.labelNames}};
  Json info = {{"input", json}, {"statistics", statisticsJson(statistics)}};
  info.update(Json::parse(toJson(result)));
  return info.dump() + "\n";
}

}  // namespace

int run(const InfoCommand& command) {
  if (const std::optional<Error> error = validateOptions(command.options)) return fail(*error);
  ConsoleProgress progress(command.json);
  const Result<ReadModel> model = loadModel(command.input, progress);
  progress.clear();
  if (!model.ok()) return fail(model.error(), command.input);
  const Result<InspectResult> result = inspectSurface(model.value().mesh, command.options, progress);
  progress.clear();
  if (!result.ok()) return fail(result.error(), command.input);
  const MeshStatistics statistics = meshStatistics(model.value().mesh);
  const std::string text = command.json ? infoJson(model.value(), statistics, result.value())
                                        : modelText(command.input, model.value()) + statisticsText(statistics) +
                                              partText(result.value()) + elementsText(result.value().brep);
  std::fputs(text.c_str(), stdout);
  return kDone;
}

}  // namespace qmcf::cli
