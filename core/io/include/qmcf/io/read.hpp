#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/mesh/quad_mesh.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"

namespace qmcf {

enum class InputFormat : std::uint8_t { obj, stlAscii, stlBinary, ply };
/// The format as a person calls it, e.g. "binary STL".
std::string_view inputFormatName(InputFormat format);

/// A model as read: polygons are triangulated, nothing is welded or repaired.
struct ReadModel {
  TriangleMesh mesh;
  InputFormat format = InputFormat::obj;
  std::int64_t polygons = 0;      ///< Faces of the file, before triangulation.
  std::int64_t skippedFaces = 0;  ///< Faces of the file that were left out because they have fewer than three corners.
};

/// Reads a model from memory; the format is found from the content. Allocations are bounded by bytes.size().
/// Errors: emptyInput, unknownFormat, truncatedInput, malformedInput, indexOutOfRange, nonFiniteCoordinate, tooLarge,
/// cancelled; messages name the line or the element.
Result<ReadModel> readModel(std::span<const std::byte> bytes, Progress& progress);

/// Per vertex of the mesh the vertex of the file that it is: itself in OBJ and PLY. STL has no vertices: there the
/// different points (0 and -0 are equal) stand for them, numbered as they first appear. Complexity O(n log n).
std::vector<std::int32_t> fileVertices(const ReadModel& model);

/// Reads an OBJ or PLY of triangles and quadrilaterals as it is, for `qmcf check`. Errors: as readModel();
/// unknownFormat also for STL, malformedInput for other polygons.
Result<QuadMesh> readQuadMesh(std::span<const std::byte> bytes, Progress& progress);

}  // namespace qmcf
