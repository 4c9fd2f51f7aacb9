#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/field/cross_field.hpp"
#include "qmcf/mesh/surface.hpp"

namespace qmcf {

/// Why a streamline ends.
enum class StreamlineEnd : std::uint8_t { length, boundary, singularity, steps };

struct StreamlineOptions {
  double length = 1e300;          ///< Arc length at which to stop, in units of the model, > 0.
  std::int32_t steps = 10000;     ///< Triangles to cross at most, >= 1.
  double leastConfidence = 0.05;  ///< Stop where crossConfidence() falls below this, in [0, 1).
};

/// A curve on the surface that follows the cross field.
struct Streamline {
  std::vector<SurfacePoint> points;  ///< From the start; one more per triangle crossed.
  double length = 0.0;
  StreamlineEnd end = StreamlineEnd::length;
};

/// Follows the branch of the field that is closest to `direction` from `start`, second order in the size of the
/// triangles. Complexity: constant per triangle crossed.
Streamline traceStreamline(const Surface& surface, const CrossField& field, const SurfacePoint& start,
                           const Vec3& direction, const StreamlineOptions& options);

}  // namespace qmcf
