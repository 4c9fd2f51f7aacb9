#pragma once

#include <cstdint>

namespace qmcf {

/// What number of elements to ask of the size field so that the front makes the wanted one. The front makes some more
/// or fewer than the field takes, which depends on the part: rows that close in on a disc's centre get too narrow
/// before one ends, those that spread over a sphere too wide. Found by secants: what is made grows like a power of what
/// is asked for.
class CountCorrection {
 public:
  /// wanted: elements, >= 1.
  explicit CountCorrection(std::int64_t wanted) : wanted_(static_cast<double>(wanted)), asked_(wanted_) {}

  /// How far a count is off: the absolute logarithm of its ratio to the wanted one; infinite for 0.
  [[nodiscard]] double miss(double made) const;

  /// What to ask for next, given that the last number asked for led to `made`; scaled for a mesh of `wanted` elements.
  /// At most half as many again as wanted, or as much fewer: what is beyond comes from small features rather than from
  /// the front, and is not made up for by larger elements elsewhere.
  std::int64_t next(double made, std::int64_t wanted);

 private:
  double wanted_;
  double asked_;
  double exponent_ = 1.0;
  bool tried_ = false;
  double x_ = 0.0;  ///< Of the last try: logarithm of what was asked for,
  double y_ = 0.0;  ///< and of what was made, in units of the wanted number.
};

}  // namespace qmcf
