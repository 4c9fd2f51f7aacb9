#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/sizing/edge_curve.hpp"
#include "qmcf/topology/brep.hpp"

namespace qmcf {

/// Pairs of boundary edges, the lower number first, that may run along each other at most `width` apart, as the two
/// sides of a crack in the file do. Nodes of one that lie on the other, but not at a node of it, would be T-junctions.
/// curves: per edge.
std::vector<std::array<std::int32_t, 2>> findSlits(const Brep& brep, const std::vector<EdgeCurve>& curves,
                                                   double width);

/// How wide a slit may be where nodes are placed across from each other: 1e-5 of the diagonal of the part's bounding
/// box, ten times what counts as a T-junction.
double slitWidth(const TriangleMesh& mesh);

/// The arc length of the place of a curve that is nearest to a point: nothing if that is farther away than `width`, or
/// no farther than that from an end.
std::optional<double> acrossSlit(const EdgeCurve& curve, const Vec3& point, double width);

}  // namespace qmcf
