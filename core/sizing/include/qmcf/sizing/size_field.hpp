#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// How large the elements shall be. Lengths are in units of the model.
struct SizingOptions {
  std::optional<double> size;         ///< Edge length everywhere, > 0. Excludes `quads`.
  std::optional<std::int64_t> quads;  ///< Number of elements to aim at, 1 to 10,000,000; default 3000 when `size` is unset.
  double gradation = 0.2;             ///< Largest |grad h|, in (0, 1].
  std::int32_t divisionsPerTurn = 8;  ///< Least number of edges in a full turn of a feature edge, >= 3.
};

/// Target edge length over the repaired mesh, linear in each triangle.
struct SizeField {
  double base = 0.0;          ///< The length asked for, or derived from the count.
  std::vector<double> value;  ///< Per vertex of the mesh, > 0.
};

/// Errors: invalidOption, cancelled.
Result<SizeField> computeSizeField(const TriangleMesh& mesh, const Brep& brep, const SizingOptions& options,
                                   Progress& progress);

}  // namespace qmcf
