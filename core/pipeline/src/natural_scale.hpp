#pragma once

#include "prepare.hpp"
#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/sizing/size_scale.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// The sizes that fit the cross fields of faces that were prepared with one size everywhere, within a factor of 1.5 (E6
/// of docs/algorithm.md). Empty where they promise little: no fewer rows of elements that end inside faces. Errors:
/// cancelled, internal.
Result<SizeScale> naturalScale(const Brep& brep, const PreparedFaces& prepared, Progress& progress);

}  // namespace qmcf
