#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/mesh/quad_mesh.hpp"

namespace qmcf::quality {

/// Which elements can be measured at all, and why the others can't.
struct Screening {
  std::vector<std::uint8_t> usable;             ///< Per element: 1 if it is in none of the three lists.
  std::vector<std::int64_t> outOfRange;         ///< Elements with an index outside the mesh.
  std::vector<std::int64_t> nonFiniteVertices;  ///< Vertices with a coordinate that is not finite.
  std::vector<std::int64_t> nonFinite;          ///< Elements that use such a vertex.
  std::vector<std::int64_t> repeatedCorner;     ///< Elements that name a vertex twice.
};

Screening screenElements(const std::vector<Vec3>& positions, const std::vector<Element>& elements);

/// Elements whose set of vertices an earlier element has too, in any order.
std::vector<std::int64_t> findDuplicates(const std::vector<Element>& elements, const std::vector<std::uint8_t>& usable);

}  // namespace qmcf::quality
