#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/mesh/patch.hpp"
#include "qmcf/mesh/surface.hpp"

namespace qmcf {

/// A point where the cross field has no direction.
struct Singularity {
  SurfacePoint point;      ///< Zero of the interpolated field.
  std::int32_t index = 0;  ///< Quarter turns: +1 becomes a vertex with 3 quads, -1 one with 5.
};

/// The orthonormal frame of a vertex: the direction with angle a is x cos a + y sin a.
struct TangentFrame {
  Vec3 x;
  Vec3 y;
  Vec3 normal;
};

/// How the constraints enter the linear system (section 3.2.2 of the paper; B1 of docs/algorithm.md).
enum class FieldSolver : std::uint8_t { eliminate, leastSquares };

/// The discretisation of the energy: cotangent weights, or the full finite elements of Knoeppel et al. (A2, A3).
enum class FieldEnergy : std::uint8_t { cotangent, finiteElements };

/// Why a cross is what it is.
enum class FieldPin : std::uint8_t { none, boundary, sharp, nonManifold, curvature, user };

/// A line in space that the field shall follow; a short one gives the direction at a point.
struct FieldStroke {
  Vec3 from;
  Vec3 to;
};

/// Which constraints apply, and how the field is solved.
struct FieldOptions {
  bool boundary = true;     ///< Align with boundary edges.
  bool sharp = true;        ///< Align with sharp and label edges.
  bool nonManifold = true;  ///< Align with non-manifold edges.
  bool curvature = true;    ///< Guide by, and with pinCurvature pin to, principal curvature directions.
  /// Align with these lines: pins the vertices within half an element of a line, at least the nearest one if that lies
  /// within an element. Edges come first; where lines contradict each other, the nearer one holds.
  std::vector<FieldStroke> strokes;
  FieldEnergy energy = FieldEnergy::cotangent;
  bool followSizes = true;  ///< Turn as elements do that grow to one side: see followSizes(), A9.
  double smoothness = 0.0;  ///< s in [-1, 1] from antiholomorphic to holomorphic energy; finiteElements only.
  FieldSolver solver = FieldSolver::eliminate;
  bool mask = true;       ///< The paper's alpha: curvature does not guide next to pinned vertices.
  double shift = 0.0;     ///< lambda of (A - lambda M) u = M q, <= 0: the lower the more curvature; leastSquares only.
  double guidance = 0.3;  ///< Strength of the curvature's pull, per (k1 - k2)^2; >= 0.
  bool pinCurvature = false;       ///< Pin the reliable curvature directions rather than let them pull alone.
  double pinAnisotropy = 0.7;      ///< Least |k1 - k2| / (|k1| + |k2|) of a reliable direction, in [0, 1].
  bool removeInconsistent = true;  ///< Take back curvature pins that contradict each other or the field (3.2.3).
  double pinTurn = 0.05;  ///< Least turn of the surface across one element, in radians, of a reliable direction.
  /// Curvature has a say only where the boundary's length over the root of the area is at most this; 0: everywhere.
  double denseBoundary = 6.0;
  bool diffuse = true;           ///< Spread the singularities by diffusing and renormalising.
  double diffusionLength = 2.5;  ///< What the last diffusion smooths over, in elements, > 0.
  /// Opposite singularities closer than this many elements, >= 0, are removed where the energy around at most doubles
  /// by that, and those within 8 elements where it does not rise. 0: all stay.
  double cancelDistance = 3.0;
};

/// A cross per vertex and what follows from it.
/// A cross is stored as the fourth power of a unit complex number: angle a and a + k pi/2 are the same u = e^(4 i a),
/// a measured in the vertex's TangentFrame.
struct CrossField {
  IdMap<VertexId, std::complex<double>> cross;  ///< |u| = 1.
  IdMap<VertexId, TangentFrame> frame;
  /// Length of the cross before it was last normalised (and before pairs were cancelled): 1 where pinned, small near
  /// singularities, where neighbours disagree. Of a smoothest field (no pins, no diffusion) the mean square is 1.
  IdMap<VertexId, double> magnitude;
  IdMap<VertexId, FieldPin> constrained;  ///< What pins the cross; where edges of several kinds meet, the last kind.
  IdMap<VertexId, std::uint8_t> removed;  ///< 1 where a curvature pin was taken back since it contradicted others.
  IdMap<TriangleId, std::int32_t> index;  ///< Quarter turns around each triangle.
  /// Per triangle: the field at its corners as u in the triangle's own frame (x along its first half-edge, normal of
  /// the triangle), continuous across the corners: their barycentric mean interpolates.
  IdMap<TriangleId, std::array<std::complex<double>, 3>> corner;
  /// Per triangle and corner: by how much the field turns further towards the corner, in radians. Not zero only where
  /// elements grow (A9), and where a boundary curve was cut into chords: there the field follows the tangent at the
  /// node and the chord in its middle.
  IdMap<TriangleId, std::array<double, 3>> extraTurn;
  std::vector<Singularity> singularities;  ///< By triangle.
  double eigenvalue = 0.0;  ///< The least one, where nothing is pinned, guides or diffuses the field; else 0.
  double energy = 0.0;      ///< Dirichlet energy of the normalised field, half of u^H A u.
};

/// The four directions of the field at a point, as unit vectors in the triangle's plane, counter-clockwise.
/// At the exact zero of the field the direction is the first corner's.
std::array<Vec3, 4> crossDirections(const Surface& surface, const CrossField& field, const SurfacePoint& point);

/// The angle of one of the four directions in the triangle's own frame, in constant time.
double crossAngle(const CrossField& field, const SurfacePoint& point);

/// How well the direction is defined at a point, in [0, 1]: the length of the interpolated u.
double crossConfidence(const CrossField& field, const SurfacePoint& point);

/// The smoothest cross field of the patch under its constraints (Knoeppel et al. 2013; section 3 of the paper).
/// edgeKinds: per edge of the B-rep, an EdgeKind as integer, to switch constraints by kind.
/// Errors: cancelled, invalidOption (a number out of its range), internal (factorisation failed).
Result<CrossField> computeCrossField(const Patch& patch, const std::vector<std::uint8_t>& edgeKinds,
                                     const FieldOptions& options, Progress& progress);

/// By how much the field breaks Gauss-Bonnet: the sum of the indices plus the sum of 2 - k over the boundary vertices
/// (k quads wanted) minus 4 chi, minus the field's own turning along an unconstrained boundary. Always 0.
std::int64_t gaussBonnetDefect(const Patch& patch, const CrossField& field);

}  // namespace qmcf
