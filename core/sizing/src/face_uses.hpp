#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// Per edge: the faces that use it an odd number of times, ascending. A division more or less there changes whether the
/// number of divisions around these faces is even.
std::vector<std::vector<std::int32_t>> oddUses(const Brep& brep);

}  // namespace qmcf
