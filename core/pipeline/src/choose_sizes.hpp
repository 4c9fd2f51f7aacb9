#pragma once

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/sizing/size_scale.hpp"
#include "trial.hpp"

namespace qmcf {

/// The sizes that a part is meshed with, and what they led to.
struct ChosenSizes {
  Trial trial;
  SizeScale scale;         ///< What the size is multiplied by from place to place; empty: nothing.
  double askedBase = 0.0;  ///< The base size for what was asked for, before the number of elements was corrected.
};

/// Meshes the faces with one size everywhere, or where that is asked for and promises a better mesh with sizes that fit
/// the cross field (E6 of docs/algorithm.md). If a number of elements is asked for, this is corrected by what the front
/// made of it: that of the size field is an estimate. Errors: those of prepareFaces().
Result<ChosenSizes> chooseSizes(const Part& part, Progress& progress);

}  // namespace qmcf
