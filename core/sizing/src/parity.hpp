#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace qmcf {

/// A change of one division, and what it does to whom.
struct ParityChange {
  std::vector<std::int32_t> faces;  ///< Faces whose parity it changes, ascending, each once.
  double cost = 0.0;                ///< >= 0.
};

struct ParitySolution {
  std::vector<bool> apply;    ///< Per change.
  std::int64_t oddFaces = 0;  ///< Faces that stay odd, because no set of changes makes them even.
};

/// Chooses cheap changes that make all odd faces even: a solution of a linear system over GF(2).
/// Changes of one or two faces are edges of a graph, solved on its cheapest spanning forest and then improved along
/// cycles; changes of more faces (non-manifold edges) are used only for components that these can't make even.
ParitySolution solveParity(std::vector<bool> odd, const std::vector<ParityChange>& changes);

}  // namespace qmcf
