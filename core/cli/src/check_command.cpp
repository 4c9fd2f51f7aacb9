#include <cmath>
#include <cstdio>

#include "commands.hpp"
#include "console.hpp"
#include "exit_status.hpp"
#include "load.hpp"
#include "qmcf/pipeline/report_json.hpp"
#include "qmcf/quality/quality.hpp"
#include "report_text.hpp"

namespace qmcf::cli {
namespace {

std::optional<Error> checkOptions(const CheckCommand& command) {
  MeshOptions options;
  options.size = command.size;
  options.featureAngle = command.featureAngle;
  return validateOptions(options);
}

}  // namespace

int run(const CheckCommand& command) {
  if (const std::optional<Error> error = checkOptions(command)) return fail(*error);
  ConsoleProgress progress(command.json);
  const Result<QuadMesh> mesh = loadQuadMesh(command.mesh, progress);
  progress.clear();
  if (!mesh.ok()) return fail(mesh.error(), command.mesh);
  std::optional<TriangleMesh> reference;
  if (!command.reference.empty()) {
    Result<ReadModel> model = loadModel(command.reference, progress);
    progress.clear();
    if (!model.ok()) return fail(model.error(), command.reference);
    reference = std::move(model).value().mesh;
  }
  QualityOptions options;
  options.size = command.size;
  options.featureAngle = command.featureAngle;
  const QualityReport report = measureQuality(mesh.value(), reference ? &*reference : nullptr, options);
  // An interrupt while measuring.
  if (!progress.report(Stage::quality, 1.0)) return fail(cancelledError(), command.mesh);
  progress.clear();
  const std::string text = command.json
                               ? toJson(report) + "\n"
                               : "Mesh      " + command.mesh + ": " + counted(report.quads, "quad", "quads") + ", " +
                                     counted(report.triangles, "triangle", "triangles") + ", " +
                                     counted(report.vertices, "vertex", "vertices") + "\n" + qualityText(report);
  std::fputs(text.c_str(), stdout);
  return report.valid ? kDone : kInvalidMesh;
}

}  // namespace qmcf::cli
