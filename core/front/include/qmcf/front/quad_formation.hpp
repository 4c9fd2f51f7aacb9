#pragma once

#include <array>
#include <optional>
#include <vector>

#include "qmcf/front/front_mesh.hpp"

namespace qmcf {

/// The faces enclosed by a closed chain of half-edges (on its inside), or nothing when the chain is not the boundary of
/// a simply connected piece of the open region: a front or the patch's boundary lies inside, or it is too large.
std::optional<std::vector<FaceId>> enclosedRegion(const FrontMesh& front, const std::vector<HalfedgeId>& boundary);

/// Makes one element of everything inside the corners, which must be joined by edges in counter-clockwise order.
/// Refused (and nothing is changed) when quality would be below `least` or enclosedRegion() has no answer.
std::optional<FaceId> formElement(FrontMesh& front, const std::vector<VertexId>& corners, double least);

/// Fills a small front loop of 4, 6, 8 or 10 edges with quads (D6 d): the best of the ways there are, by shape and by
/// how regular its vertices become. Returns the new quads, none if no way is good enough.
std::vector<FaceId> closeLoop(FrontMesh& front, HalfedgeId h, int length, double least);

}  // namespace qmcf
