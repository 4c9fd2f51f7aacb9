#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "qmcf/io/write.hpp"
#include "qmcf/mesh/quad_mesh.hpp"

namespace qmcf {

/// Which characters a format allows in a name.
enum class NameRule : std::uint8_t {
  word,        ///< No blanks, no control characters, no quotes; UTF-8.
  quotedText,  ///< Anything but quotes and control characters; UTF-8.
  identifier,  ///< ASCII letters, digits and '_', beginning with a letter.
};

/// Names of faces and edges, all different, none empty, at most 80 bytes each.
struct GroupNames {
  std::vector<std::string> faces;
  std::vector<std::string> edges;
};
/// As many names as the mesh uses. In a format that ignores case, names differ by more than case.
GroupNames groupNames(const QuadMesh& mesh, const WriteOptions& options, NameRule rule);

/// Face of an element; 0 where elementFace says nothing.
std::int32_t faceOf(const QuadMesh& mesh, std::size_t element);
/// 1 + the largest face in use.
std::size_t faceCount(const QuadMesh& mesh);
/// 1 + the largest edge in use.
std::size_t edgeCount(const QuadMesh& mesh);

/// The feature segments sorted by edge, in their order within each; those of no edge are left out.
std::vector<std::vector<FeatureSegment>> segmentsByEdge(const QuadMesh& mesh);

std::string writeObj(const QuadMesh& mesh, const WriteOptions& options);
std::string writeVtuMesh(const QuadMesh& mesh, const WriteOptions& options);
std::string writePly(const QuadMesh& mesh, const WriteOptions& options);
std::string writeStl(const QuadMesh& mesh);
std::string writeMsh(const QuadMesh& mesh, const WriteOptions& options);
std::string writeInp(const QuadMesh& mesh, const WriteOptions& options);
std::string writeBdf(const QuadMesh& mesh, const WriteOptions& options);

}  // namespace qmcf
