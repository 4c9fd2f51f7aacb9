#pragma once

#include <vector>

#include "face_reference.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/sizing/size_field.hpp"

namespace qmcf {

/// Where the triangulation is too coarse for its face: vertices of the face, no nearer to each other than about a
/// quarter of the base size, that lie farther from the patch than half the local size (a limb thinner than an element,
/// say), each with half that size; nothing smaller than 0.3 of the base size.
std::vector<SizeLimit> findMissedPlaces(const Surface& face, const FaceReference& reference, const Patch& patch,
                                        double base);

}  // namespace qmcf
