#pragma once

#include <string>
#include <vector>

#include "qmcf/base/result.hpp"
#include "qmcf/field/cross_field.hpp"

namespace qmcf::cli {

/// The lines of a file like {"strokes": [{"from": [0, 0, 0], "to": [1, 0, 0]}]}.
/// Errors: those of readFile(); invalidOption if it is no such file.
Result<std::vector<FieldStroke>> readConstraints(const std::string& path);

}  // namespace qmcf::cli
