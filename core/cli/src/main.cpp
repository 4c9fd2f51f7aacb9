#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <new>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "commands.hpp"
#include "console.hpp"
#include "constraints_file.hpp"
#include "exit_status.hpp"
#include "sizing_file.hpp"

namespace qmcf::cli {
namespace {

constexpr const char* kFooter =
    "Exit status: 0 done; 1 the mesh is not valid (check only); 2 wrong usage or an output that can't be written;\n"
    "3 input that can't be used; 4 cancelled; 5 internal error.";

/// Memory that a stage has given back is kept for the next one: asking the system for the same pages again takes up to
/// a tenth of the time of a large mesh.
void keepMemory() {
#ifdef __GLIBC__
  constexpr int kMost = 1 << 30;  // Bytes.
  mallopt(M_TRIM_THRESHOLD, kMost);
  mallopt(M_MMAP_THRESHOLD, kMost);
#endif
}

/// One flag for each "no-align": given, it turns the option off.
void addAlignFlag(CLI::App& app, const std::string& name, bool& option, const std::string& what) {
  app.add_flag_callback(
      "--no-align-" + name, [&option] { option = false; }, "Don't align the field with " + what);
}

void addPartOptions(CLI::App& app, MeshOptions& options) {
  app.add_option("--feature-angle", options.featureAngle, "Dihedral angle in degrees from which an edge is sharp")
      ->capture_default_str();
  app.add_flag_callback(
      "--no-repair", [&options] { options.repair = false; }, "Report the model's defects and leave them as they are");
}

void addSizeOptions(CLI::App& app, MeshOptions& options, std::string& sizing) {
  auto* const size = app.add_option("--size", options.size, "Edge length of the elements, in units of the model");
  auto* const sizes = app.add_option("--sizing", sizing,
                                     "Edge length at each vertex of the model, one number per line in the model's\n"
                                     "order, as --sizing-out writes them; with --size, the smaller of both");
  sizes->type_name("FILE");
  app.add_option("--quads", options.quads, "Number of elements to aim at (3000 unless --size or --sizing is given)")
      ->excludes(size)
      ->excludes(sizes);
  app.add_option("--curvature", options.curvature,
                 "Chord error: how far edges of elements may be from curved faces, in units of the model\n"
                 "(elements get no smaller by it than a tenth of the size)")
      ->type_name("DISTANCE");
  app.add_option("--gradation", options.gradation, "Largest slope of the element size, up to 1")->capture_default_str();
}

void addFieldOptions(CLI::App& app, MeshOptions& options, std::string& constraints, std::string& sizing) {
  addSizeOptions(app, options, sizing);
  addPartOptions(app, options);
  app.add_option("--threads", options.threads,
                 "Faces worked on at a time, 1 to 256 (as many as the machine has threads)");
  addAlignFlag(app, "boundary", options.alignBoundary, "boundary edges");
  addAlignFlag(app, "sharp", options.alignSharp, "sharp edges");
  addAlignFlag(app, "non-manifold", options.alignNonManifold, "non-manifold edges");
  addAlignFlag(app, "curvature", options.alignCurvature, "principal curvature");
  app.add_option("--constraints", constraints, "Lines that the field shall follow")->type_name("FILE.json");
}

void addMesh(CLI::App& app, MeshCommand& command) {
  app.add_option("input", command.input, "Model: OBJ, STL or PLY")->type_name("IN")->required();
  app.add_option("-o,--output", command.output, "Mesh: .obj .ply .stl .vtu .msh .inp .bdf")
      ->type_name("OUT")
      ->required();
  addFieldOptions(app, command.options, command.constraints, command.sizing);
  std::optional<bool>& fitSizes = command.options.fitSizes;
  app.add_flag_callback(
      "--fit-sizes", [&fitSizes] { fitSizes = true; },
      "Let sizes vary to fit the cross field, where that promises better elements: mostly by less than 1.5 and\n"
      "by 3 at most either way (the default with a number of elements)");
  app.add_flag_callback(
      "--no-fit-sizes", [&fitSizes] { fitSizes = false; }, "One size wherever the part allows it");
  const std::map<std::string, Mode> modes{{"qmcf", Mode::qmcf}, {"qmorph", Mode::qmorph}};
  app.add_option("--mode", command.options.mode, "Advancing front: qmcf (guided by the field) or qmorph (the original)")
      ->transform(CLI::CheckedTransformer(modes).description(""))
      ->type_name("MODE")
      ->default_str("qmcf");
  app.add_flag("--all-quad", command.options.allQuad,
               "Quadrilaterals only: triangles are paired; where that fails, larger elements are all cut up");
  app.add_option("--report", command.report, "Write a report")->type_name("FILE.json");
  app.add_option("--trace", command.trace, "Write the history of the front, step by step")->type_name("FILE.json");
  CLI::Option* const sizingOut =
      app.add_option("--sizing-out", command.sizingOut, "Write the target edge length at each vertex of the model")
          ->type_name("FILE");
  app.add_option("--sizing-mesh", command.sizingMesh,
                 "Write the triangles that the target edge length is linear on; --sizing-out then tells it at their "
                 "vertices")
      ->type_name("OUT")
      ->needs(sizingOut);
  app.add_flag("--quiet", command.quiet, "Print nothing but errors and warnings");
}

void addField(CLI::App& app, FieldCommand& command) {
  app.add_option("input", command.input, "Model: OBJ, STL or PLY")->type_name("IN")->required();
  app.add_option("-o,--output", command.output, "Field and singularities")->type_name("OUT.vtu")->required();
  addFieldOptions(app, command.options, command.constraints, command.sizing);
  app.add_flag("--quiet", command.quiet, "Print nothing but errors");
}

void addCheck(CLI::App& app, CheckCommand& command) {
  app.add_option("mesh", command.mesh, "Mesh of quadrilaterals and triangles: OBJ or PLY")
      ->type_name("OUT")
      ->required();
  app.add_option("--ref", command.reference, "Model that was meshed")->type_name("IN");
  app.add_option("--size", command.size, "Edge length that was asked for");
  app.add_option("--feature-angle", command.featureAngle, "Dihedral angle in degrees from which an edge is sharp")
      ->capture_default_str();
  app.add_flag("--json", command.json, "Print JSON");
}

void addInfo(CLI::App& app, InfoCommand& command) {
  app.add_option("input", command.input, "Model: OBJ, STL or PLY")->type_name("IN")->required();
  addPartOptions(app, command.options);
  app.add_flag("--json", command.json, "Print JSON");
}

/// Runs a command with what the files say that its options name.
template <class Command>
int runWithFiles(Command& command) {
  if (!command.constraints.empty()) {
    Result<std::vector<FieldStroke>> strokes = readConstraints(command.constraints);
    if (!strokes.ok()) return fail(strokes.error(), command.constraints);
    command.options.strokes = std::move(strokes).value();
  }
  if (!command.sizing.empty()) {
    Result<std::vector<double>> sizes = readSizing(command.sizing);
    if (!sizes.ok()) return fail(sizes.error(), command.sizing);
    command.options.sizes = std::move(sizes).value();
  }
  return run(command);
}

int runProgram(int argc, char** argv) {
  CLI::App app("QMCF: quad meshes that follow edges, curvature and the element size asked for.", "qmcf");
  app.set_version_flag("--version", "qmcf " QMCF_VERSION);
  app.require_subcommand(1);
  app.footer(kFooter);
  MeshCommand mesh;
  FieldCommand field;
  CheckCommand check;
  InfoCommand info;
  CLI::App* const meshApp = app.add_subcommand("mesh", "Mesh a model with quadrilaterals");
  CLI::App* const fieldApp = app.add_subcommand("field", "Write the cross field of a model");
  CLI::App* const checkApp = app.add_subcommand("check", "Validate and measure a mesh");
  CLI::App* const infoApp = app.add_subcommand("info", "Print what a model holds: repairs, faces, edges, vertices");
  addMesh(*meshApp, mesh);
  addField(*fieldApp, field);
  addCheck(*checkApp, check);
  addInfo(*infoApp, info);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
  catchInterrupts();
  if (meshApp->parsed()) return runWithFiles(mesh);
  if (fieldApp->parsed()) return runWithFiles(field);
  if (checkApp->parsed()) return run(check);
  return run(info);
}

}  // namespace
}  // namespace qmcf::cli

int main(int argc, char** argv) {
  qmcf::cli::keepMemory();
  try {
    return qmcf::cli::runProgram(argc, argv);
  } catch (const std::bad_alloc&) {
    return qmcf::cli::fail({qmcf::ErrorCode::tooLarge, "The model or its mesh needs more memory than there is.", {}});
  } catch (const std::exception& error) {
    return qmcf::cli::fail({qmcf::ErrorCode::internal, std::string("Internal error: ") + error.what(), {}});
  }
}
