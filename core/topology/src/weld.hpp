#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/mesh/triangle_mesh.hpp"

namespace qmcf::detail {

/// Per vertex that a triangle uses the first such vertex at the same point; kNone for the others. 0 equals -0.
std::vector<std::int32_t> firstAtSamePoint(const TriangleMesh& mesh);

/// STL stores every triangle with three vertices of its own; that is the format, not a defect of the model.
bool isTriangleList(const TriangleMesh& mesh);

}  // namespace qmcf::detail
