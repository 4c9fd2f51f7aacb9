#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "qmcf/base/vec.hpp"

namespace qmcf {

/// A triangle soup with shared vertices, as read from a file: no promise of manifoldness, orientation or cleanliness.
struct TriangleMesh {
  std::vector<Vec3> positions;                         ///< In units of the file.
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< Indices into positions, counter-clockwise seen from outside.
  std::vector<std::int32_t> labels;                    ///< Optional: per triangle, an index into labelNames.
  std::vector<std::string> labelNames;                 ///< Optional: groups, objects or solids of the file.
};

}  // namespace qmcf
