#pragma once

#include <optional>
#include <string>

#include "qmcf/pipeline/mesh_surface.hpp"

namespace qmcf::cli {

/// qmcf mesh IN -o OUT
struct MeshCommand {
  std::string input;
  std::string output;
  std::string report;       ///< Empty: none.
  std::string trace;        ///< Empty: none.
  std::string constraints;  ///< File of strokes; empty: none.
  std::string sizing;       ///< File with sizes at the input's vertices; empty: none.
  std::string sizingOut;    ///< File for the target sizes at the input's vertices; empty: none.
  std::string sizingMesh;   ///< File for triangles, whose vertices the target sizes are for then; empty: none.
  MeshOptions options;
  bool quiet = false;
};
int run(const MeshCommand& command);

/// qmcf field IN -o OUT.vtu
struct FieldCommand {
  std::string input;
  std::string output;
  std::string constraints;  ///< File of strokes; empty: none.
  std::string sizing;       ///< File with sizes at the input's vertices; empty: none.
  MeshOptions options;
  bool quiet = false;
};
int run(const FieldCommand& command);

/// qmcf check OUT --ref IN
struct CheckCommand {
  std::string mesh;
  std::string reference;  ///< Empty: the mesh alone is checked.
  std::optional<double> size;
  double featureAngle = 30.0;
  bool json = false;
};
int run(const CheckCommand& command);

/// qmcf info IN
struct InfoCommand {
  std::string input;
  MeshOptions options;
  bool json = false;
};
int run(const InfoCommand& command);

}  // namespace qmcf::cli
