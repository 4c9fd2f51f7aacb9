#pragma once

namespace qmcf::cli {

/// Exit statuses of the program. Those of errors come from errors.def: 2 wrong usage, 3 input that can't be used,
/// 4 cancelled, 5 internal.
inline constexpr int kDone = 0;
inline constexpr int kInvalidMesh = 1;  ///< `check` only: the mesh was read and is not valid.
inline constexpr int kWrongUsage = 2;   ///< Also when the output can't be written.

}  // namespace qmcf::cli
