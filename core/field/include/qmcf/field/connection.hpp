#pragma once

#include <complex>

#include "qmcf/mesh/ids.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/mesh/surface.hpp"

namespace qmcf {

/// How directions at neighbouring vertices compare (Knoeppel et al. 2013; A1 and A7 of docs/algorithm.md).
/// The fan of a vertex is unrolled into its tangent plane with its angles scaled to a total of 2 pi inside and of
/// k pi/2 at a boundary vertex that wants k quads, so that both boundary edges are directions of the same cross.
/// The direction of the half-edge Surface::outgoing(v) has angle 0.
struct Connection {
  IdMap<HalfedgeId, double> corner;  ///< Euclidean angle at the half-edge's origin in its triangle.
  IdMap<HalfedgeId, double> scaled;  ///< The same, scaled.
  IdMap<HalfedgeId, double> angle;   ///< Direction of the half-edge at its origin.
  IdMap<VertexId, double> fan;       ///< Sum of the Euclidean angles.
  IdMap<VertexId, double> total;     ///< Sum of the scaled angles.
  /// By how much a direction turns further when it is moved along the half-edge, since elements grow to one side of it:
  /// followSizes(). Empty: not at all.
  IdMap<HalfedgeId, double> growth;
};

/// Complexity O(n). Degenerate triangles count with angle 0; a fan of such triangles alone is divided evenly.
Connection buildConnection(const Patch& patch);

/// Measures by the patch's sizes h: lengths in elements instead of units of the model. Angles stay, but straight
/// lines bend around smaller elements: along a path directions turn by the integral of J grad(ln h) more (A9 of
/// docs/algorithm.md). Along the boundary, which is straight for crosses, nothing changes. Sizes that are the same
/// everywhere change nothing.
void followSizes(const Patch& patch, Connection& connection);

/// Quads wanted at a boundary vertex, 1 to 4: Patch::cornerQuads, or from the fan's angle where the patch does not say.
std::int32_t wantedQuads(const Patch& patch, VertexId boundaryVertex, double fanAngle);

/// The angle to add to a direction at h's origin to have the parallel direction at its target.
double transportAngle(const Surface& surface, const Connection& connection, HalfedgeId h);

/// The factor that moves a cross from h's origin to its target; exactly 1 along the boundary, and exactly conjugate for
/// the twin.
std::complex<double> transportCross(const Surface& surface, const Connection& connection, HalfedgeId h);

/// Angle by which a direction turns when it is moved around the triangle, not reduced modulo 2 pi. Over a patch these
/// add up to 2 pi chi - pi/2 * (sum of 2 - k over the boundary vertices), whatever the sizes.
double triangleCurvature(const Connection& connection, TriangleId t);

}  // namespace qmcf
