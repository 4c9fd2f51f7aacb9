#pragma once

#include <string_view>

#include "qmcf/base/result.hpp"
#include "qmcf/io/read.hpp"

namespace qmcf {

/// Finds the format from the content; a byte order mark must have been removed.
/// Errors: emptyInput, unknownFormat (names the format when it is a known one).
Result<InputFormat> detectFormat(std::string_view bytes);

}  // namespace qmcf
