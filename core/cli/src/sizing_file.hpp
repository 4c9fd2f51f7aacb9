#pragma once

#include <string>
#include <vector>

#include "qmcf/base/result.hpp"
#include "qmcf/io/read.hpp"

namespace qmcf::cli {

/// One number per line.
std::string sizingText(const std::vector<double>& size);

/// One number per line for each vertex of the file (fileVertices()), in its order. `size`: per vertex as read.
std::string sizingText(const ReadModel& model, const std::vector<double>& size);

/// The numbers of such a file, each above 0. Empty lines at its end are allowed.
/// Errors: those of readFile(); malformedInput, naming the line.
Result<std::vector<double>> readSizing(const std::string& path);

/// Numbers for the vertices of a model's file as numbers for its vertices as read.
/// Errors: malformedInput if the file has more or fewer vertices.
Result<std::vector<double>> spreadSizing(const std::vector<double>& sizes, const ReadModel& model);

}  // namespace qmcf::cli
