#pragma once

#include <cstdint>
#include <vector>

#include "structure.hpp"

namespace qmcf::quality {

/// Places where a boundary nearly meets another one: the surface looks closed there but is not.
struct Seams {
  std::vector<std::int64_t> cracks;      ///< Boundary vertices at the same place as another one (1e-9 of the diagonal).
  std::vector<std::int64_t> tJunctions;  ///< Boundary vertices in the inside of a boundary edge (1e-6 of the diagonal).
  bool any = false;  ///< A boundary vertex lies within 1e-6 of the diagonal of a foreign boundary edge.
};

/// diagonal: of the bounding box.
Seams findSeams(const std::vector<Vec3>& positions, const Structure& structure, double diagonal);

}  // namespace qmcf::quality
