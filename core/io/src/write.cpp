#include "qmcf/io/write.hpp"

#include <array>
#include <utility>

#include "mesh_writers.hpp"
#include "text_cursor.hpp"

namespace qmcf {

std::optional<OutputFormat> outputFormatOf(std::string_view fileName) {
  constexpr auto kExtensions = std::to_array<std::pair<std::string_view, OutputFormat>>({{"obj", OutputFormat::obj},
                                                                                         {"vtu", OutputFormat::vtu},
                                                                                         {"ply", OutputFormat::ply},
                                                                                         {"stl", OutputFormat::stl},
                                                                                         {"msh", OutputFormat::msh},
                                                                                         {"inp", OutputFormat::inp},
                                                                                         {"bdf", OutputFormat::bdf},
                                                                                         {"nas", OutputFormat::bdf}});
  const std::size_t dot = fileName.rfind('.');
  if (dot == std::string_view::npos) return std::nullopt;
  for (const auto& [extension, format] : kExtensions) {
    if (equalsIgnoringCase(fileName.substr(dot + 1), extension)) return format;
  }
  return std::nullopt;
}

std::string writeMesh(const QuadMesh& mesh, OutputFormat format, const WriteOptions& options) {
  switch (format) {
    case OutputFormat::obj:
      return writeObj(mesh, options);
    case OutputFormat::vtu:
      return writeVtuMesh(mesh, options);
    case OutputFormat::ply:
      return writePly(mesh, options);
    case OutputFormat::stl:
      return writeStl(mesh);
    case OutputFormat::msh:
      return writeMsh(mesh, options);
    case OutputFormat::inp:
      return writeInp(mesh, options);
    case OutputFormat::bdf:
      return writeBdf(mesh, options);
  }
  return {};
}

}  // namespace qmcf
