#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "qmcf/base/result.hpp"

namespace qmcf::cli {

/// The whole content of a file or pipe. Errors: malformedInput when it can't be read, tooLarge above 2 GiB.
Result<std::vector<std::byte>> readFile(const std::string& path);

/// Why the file could not be written, if so. Called before a long run, so that its result is not lost at the end.
std::optional<Error> checkWritable(const std::string& path);

/// Writes under a temporary name beside the file and renames it: at no time is there half a file. What is no regular
/// file (a device, a pipe) is written directly.
std::optional<Error> writeFile(const std::string& path, std::string_view content);

}  // namespace qmcf::cli
