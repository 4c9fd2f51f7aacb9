#pragma once

#include <array>
#include <cstddef>

#include "qmcf/base/vec.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"

namespace qmcf {

/// How far an element is from facing the way of the surface below it: 0 where none of its corners is turned over, else
/// in (0, 1], the largest over the corners. A corner is turned over when its normal opposes the surface near it: a
/// triangle closest to the element's centre, whichever of them where several are equally near, and all triangles of the
/// patch under the corner, so that elements that meet a sharp edge don't count. It then is as far as the cosine to the
/// former is from 0 or as the nearest triangle that agrees is from the patch, in units of the element, whichever is
/// less. corners: the first `count` of them, 3 or 4; below: the point of the surface closest to their mean.
/// \pre the surface is not empty
double turnedOverBy(const TriangleBvh& surface, const std::array<Vec3, 4>& corners, std::size_t count,
                    const ClosestPoint& below);

}  // namespace qmcf
