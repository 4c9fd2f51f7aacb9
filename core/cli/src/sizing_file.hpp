#pragma once

#include <string>
#include <vector>

#include "qmcf/io/read.hpp"

namespace qmcf::cli {

/// One number per line for each vertex of the file, in its order. STL has no vertices: there, for each different point,
/// in the order of their first appearance. `size`: per vertex as read.
std::string sizingText(const ReadModel& model, const std::vector<double>& size);

}  // namespace qmcf::cli
