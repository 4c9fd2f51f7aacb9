#pragma once

#include <cstddef>
#include <span>

#include "qmcf/mesh/triangle_mesh.hpp"

namespace qmcf::fuzz {

/// Any bytes as triangles between points of a small lattice, some of them moved a little, at any scale and offset:
/// nearly every input is a mesh, and every defect there is comes up in combination with the others.
TriangleMesh soupFromBytes(std::span<const std::byte> bytes);

}  // namespace qmcf::fuzz
