#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"

namespace qmcf {

/// How many threads the machine runs at once, at least 1; 1 where the library is built without threads (WebAssembly).
std::int32_t hardwareThreads();

/// One of several independent pieces of work. It returns why it failed, if it did, and must write to nothing that
/// another piece reads or writes. Its Progress is its own; what it reports becomes its share of the whole.
using IndexedWork = std::function<std::optional<Error>(std::size_t index, Progress& progress)>;

/// Calls work(i, …) once for each i in [0, costs.size()), up to `threads` (>= 1) at a time, the dearest first; costs
/// are relative and at least 0. The calling thread works along, and `progress` is called by it alone, with fractions
/// that never fall within a stage.
///
/// What is returned does not depend on the number of threads: nothing if all succeeded, else the error of the smallest
/// index that failed, whichever came first; pieces with larger indices are stopped or left out. Once progress asked to
/// stop, all are, and the error is cancelledError(). An exception of a piece counts as its error and is thrown here.
std::optional<Error> parallelFor(const std::vector<double>& costs, std::int32_t threads, Progress& progress,
                                 const IndexedWork& work);

}  // namespace qmcf
