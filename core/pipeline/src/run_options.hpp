#pragma once

#include <cstdint>

#include "qmcf/pipeline/mesh_surface.hpp"

namespace qmcf {

/// What becomes of the triangles that fronts leave.
enum class Leftovers : std::uint8_t {
  stay,
  paired,  ///< Quadrilaterals, in pairs; where that is not possible, smaller elements are tried.
  cut,     ///< They and all other elements are cut at the middles of their edges.
};

/// What is asked for, and the way that is tried to make it.
struct RunOptions : MeshOptions {
  Leftovers leftovers = Leftovers::stay;  ///< Not `stay` in a run for quadrilaterals only (allQuad).
};

}  // namespace qmcf
