#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// Edges that want the same number of divisions because they are opposite sides of a face that a regular grid can fill:
/// four corners joined by single edges, or a ring between two closed edges. Groups of two or more edges, ascending.
/// `wanted`: per edge, the number of divisions as a real number. Edges much unlike each other are not grouped.
std::vector<std::vector<std::int32_t>> oppositeEdges(const Brep& brep, const std::vector<double>& wanted);

}  // namespace qmcf
