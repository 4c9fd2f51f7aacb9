#pragma once

#include <cstdint>

namespace qmcf {

/// How many elements were asked of the size field, and how many the front made.
struct CountTrial {
  std::int64_t asked = 0;
  double made = 0.0;
};

/// A whole number of elements that can be asked for, 1 to 10,000,000.
std::int64_t roundedCount(double count);

/// What number of elements to ask of the size field for about `wanted`. The front makes some more or fewer than the
/// field takes, which depends on the part: rows that close in on a disc's centre get too narrow before one ends, those
/// that spread over a sphere too wide. Returns what was asked for, scaled to `wanted`, where nothing is to be
/// corrected: the count is off by less than 4 %, or there are more than 20 % too many, which come from small features
/// and are not made up for by larger elements elsewhere. At most half as many again.
std::int64_t correctedCount(const CountTrial& trial, std::int64_t wanted);

/// The same after two trials for the same number, by interpolation of the logarithms if one made more and one fewer;
/// else what the nearer one asked for.
std::int64_t correctedCount(const CountTrial& first, const CountTrial& second, std::int64_t wanted);

}  // namespace qmcf
