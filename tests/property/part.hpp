#pragma once

#include <cstdint>
#include <string>

#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/pipeline/mesh_surface.hpp"

namespace qmcf::property {

/// How large a case may get.
struct Limits {
  double sizeRange = 100.0;  ///< The largest size is so many times the smallest one.
  double smallest = 0.01;    ///< Size in units of the part's diagonal.
};

/// A part of which the truth is known, and what is asked of the mesher.
struct Case {
  std::string name;                      ///< What kind of part, for a person.
  TriangleMesh part;                     ///< Manifold, oriented, conforming.
  std::int64_t eulerCharacteristic = 0;  ///< Known from how the part was made.
  std::int64_t boundaryLoops = 0;
  std::int64_t components = 1;
  MeshOptions options;
};

/// The case of a seed, the same on every platform: a planar polygon with holes, an extrusion, a revolution, all the way
/// round or part of it, or a vase with poles; anywhere, turned any way, 1e-3 to 1e3 across; an element size, a front.
Case makeCase(std::uint64_t seed, const Limits& limits);

}  // namespace qmcf::property
