#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "qmcf/field/cross_field.hpp"

namespace qmcf::testing {

/// The field of a patch; a failed expectation if there is none.
inline CrossField solve(const Patch& patch, const FieldOptions& options = {}) {
  SilentProgress progress;
  Result<CrossField> field = computeCrossField(patch, {}, options, progress);
  EXPECT_TRUE(field.ok());
  return std::move(field).value();
}

}  // namespace qmcf::testing
