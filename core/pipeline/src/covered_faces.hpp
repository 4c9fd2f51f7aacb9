#pragma once

#include <cstdint>
#include <vector>

#include "part.hpp"
#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"

namespace qmcf {

/// What becomes of layers that lie on each other.
struct CoveredFaces {
  std::vector<std::int32_t> below;   ///< Per face: the one that stands for it, or kNone.
  std::vector<std::uint8_t> turned;  ///< Per face: 1 if its elements have to run the other way to fit the faces around.
};

/// Faces between the same edges as another one and nowhere farther from it than `distance`: two layers that elements
/// of a larger size can't tell apart, so that only one of them can be meshed: the one whose orientation agrees better
/// with the faces around. Errors: cancelled.
Result<CoveredFaces> coveredFaces(const Part& part, double distance, Progress& progress);

}  // namespace qmcf
