#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/quad_mesh.hpp"

namespace qmcf {

enum class OutputFormat : std::uint8_t { obj, vtu };
/// By file name extension, case ignored.
std::optional<OutputFormat> outputFormatOf(std::string_view fileName);

struct WriteOptions {
  std::vector<std::string> faceNames;  ///< Per face of the B-rep: group name; empty: "face_N".
};

/// The file's content. Coordinates are written so that reading them gives the same doubles.
std::string writeMesh(const QuadMesh& mesh, OutputFormat format, const WriteOptions& options = {});

}  // namespace qmcf
