#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/quad_mesh.hpp"

namespace qmcf {

/// OBJ with groups and line elements; VTK unstructured grid (XML, ASCII); PLY and STL (binary, little endian; STL in
/// single precision with quadrilaterals cut in two); Gmsh MSH 4.1 (ASCII); Abaqus and CalculiX INP; Nastran BDF.
enum class OutputFormat : std::uint8_t { obj, vtu, ply, stl, msh, inp, bdf };
/// By file name extension, case ignored.
std::optional<OutputFormat> outputFormatOf(std::string_view fileName);

struct WriteOptions {
  std::vector<std::string>
      faceNames;  ///< Per face of the B-rep: group name; empty or missing: "face_N", N being its id.
  std::vector<std::string>
      edgeNames;  ///< Per edge of the B-rep: group name; empty or missing: "edge_N", N being its id.
};

/// The file's content, bytes. Coordinates are written so that reading them gives the same doubles, but in STL (single
/// precision), INP and BDF (as many digits as 20 and 16 characters hold). Faces and feature edges become named groups
/// (OBJ groups, physical groups, element and node sets, properties) where the format has them; names lose the
/// characters that the format can't hold, and equal names are numbered.
std::string writeMesh(const QuadMesh& mesh, OutputFormat format, const WriteOptions& options = {});

}  // namespace qmcf
