#pragma once

#include "part.hpp"

namespace qmcf::property {

/// For the long run: about 1 to 10,000 elements.
constexpr Limits kLargeCases{100.0, 0.01};
/// For the tests of every build: about 1 to 200 elements.
constexpr Limits kSmallCases{10.0, 0.1};

}  // namespace qmcf::property
