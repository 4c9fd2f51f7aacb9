#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "qmcf/base/result.hpp"
#include "qmcf/mesh/quad_mesh.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"

namespace qmcf {

/// Mean, worst and quantiles of one metric over the elements for which it is finite; all NaN (null in JSON) when there
/// is none.
struct Distribution {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double worst = std::numeric_limits<double>::quiet_NaN();
  /// The worst 1 % of the elements are worse than this (interpolated between elements).
  double p1 = std::numeric_limits<double>::quiet_NaN();
  double median = std::numeric_limits<double>::quiet_NaN();
  std::int64_t infinite = 0;  ///< Elements left out because the metric is not finite.
};

/// Shape of one quadrilateral. Definitions and sources: section F of docs/algorithm.md.
struct QuadMetrics {
  double scaledJacobian = 0.0;  ///< min over corners, in [-1, 1], 1 best (Verdict).
  double jacobianRatio = 0.0;   ///< max / min at the corners, >= 1, 1 best (ANSYS, MAPDL form); infinite if inverted.
  double jacobianRatioGauss = 0.0;  ///< The same at the 2 x 2 Gauss points.
  double aspectRatio = 0.0;         ///< ANSYS rectangles, >= 1, 1 best.
  double edgeRatio = 0.0;           ///< Longest over shortest edge.
  double orthogonalQuality = 0.0;   ///< In [-1, 1], 1 best.
  double minAngle = 0.0;            ///< Degrees.
  double maxAngle = 0.0;            ///< Degrees; above 180 at an inverted corner.
  double skewness = 0.0;            ///< Equiangle, in [0, 1], 0 best.
  double warpage = 0.0;             ///< Degrees between the normals across a diagonal, larger of the two.
};
/// Metrics that divide by a vanishing length or area are infinite (ratios) or 0 (scaled Jacobian, orthogonal quality).
QuadMetrics quadMetrics(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// The scaled Jacobian alone, for those who need it often.
double quadScaledJacobian(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// Scaled Jacobian of a triangle in [0, 1]: 1 for the equilateral one, 0 for one without area.
double triangleScaledJacobian(const Vec3& a, const Vec3& b, const Vec3& c);

/// What a check of the validator came to.
enum class CheckStatus : std::uint8_t {
  pass,
  warn,  ///< Worth knowing; the mesh is valid all the same.
  fail,  ///< The mesh is not valid.
  skip,  ///< Can't be decided: the reference is missing or does not have the property itself.
};
/// The status' name; the same in C++, JSON and TypeScript.
std::string_view checkStatusName(CheckStatus status);

/// One check of the validator.
struct ValidityCheck {
  std::string name;  ///< Identifier, e.g. "nonManifoldEdges".
  CheckStatus status = CheckStatus::pass;
  std::int64_t count = 0;              ///< Defects found; 0 unless the status is warn or fail.
  std::vector<std::int64_t> elements;  ///< All ids, 0-based: of elements or vertices, as the sentence says.
  std::string sentence;                ///< For a person; empty when passed.
};

/// The checks of a mesh, in a fixed order.
struct ValidityReport {
  std::vector<ValidityCheck> checks;
  bool valid = true;  ///< No check failed.
};

/// Structural checks of a mesh alone, cheap enough to follow every stage: O(n), no search in space.
/// "empty", "indexOutOfRange", "nonFiniteCoordinate", "repeatedCorner", "duplicateElements", "orientationConflicts",
/// "invertedElements" (quads with scaled Jacobian <= 1e-9, triangles without area), "featureSegments" (segments that
/// are no edge of the mesh) and "nonManifoldEdges" (more than two elements, off the feature segments) fail;
/// "nonManifoldVertices" (more than one fan, off the feature segments), "unreferencedVertices", and
/// "orientationConflicts" on feature segments alone warn.
/// Elements that fail one of the second to fourth check are left out of the others.
ValidityReport validateMesh(const QuadMesh& mesh);

/// The irregular vertices of one kind in a ledger.
struct LedgerEntry {
  std::int32_t elements = 0;  ///< At each of the vertices.
  std::int64_t vertices = 0;
  std::int64_t index = 0;  ///< Of all of them together, in quarter turns.
};

/// The Gauss-Bonnet ledger of a mesh of quadrilaterals and triangles (A6 of docs/algorithm.md): what its irregular
/// vertices, its boundary and its triangles are worth in quarter turns is four times its Euler characteristic.
///
/// The mesh is taken sheet by sheet: it is cut along the edges with more than two elements and apart where fans of
/// elements share nothing but a vertex, so that every sheet is a surface with or without boundary, oriented or not. Let
/// it have V vertices, E edges (B of them on the boundary), Q quads and T triangles; X = V - E + Q + T. Sides of
/// elements are counted twice by inner edges and once by those of the boundary: 4 Q + 3 T = 2 E - B. So
///
///   4 X = 4 V - 4 E + (4 Q + 3 T) + T = 4 V - 2 E - B + T.
///
/// 2 E is the sum of the edges at each vertex. A vertex inside with f elements has f edges; one on the boundary, where
/// its elements are one fan, has f + 1, two of which are of the boundary; loops of the boundary have as many vertices
/// as edges, so B takes one more from each. What is left is an identity of whole numbers, for every such mesh:
///
///   sum over inner vertices (4 - f) + sum over boundary vertices (2 - f) + T = 4 X.
struct IndexLedger {
  std::vector<LedgerEntry> interior;  ///< Other than four elements, 4 - elements each; ascending.
  std::vector<LedgerEntry> boundary;  ///< Other than two elements, 2 - elements each; ascending. Corners are here.
  std::int64_t interiorIndex = 0;
  std::int64_t boundaryIndex = 0;
  std::int64_t triangles = 0;  ///< Worth +1 each: every triangle leaves an irregular vertex somewhere.
  std::int64_t sheets = 0;
  std::int64_t fourEuler = 0;  ///< 4 X of all sheets, from vertices, edges and elements.
  /// The same of the reference, counted on its own triangles. Absent without one, and where it is undecidable: it has
  /// edges with more than two triangles or pieces that don't quite meet.
  std::optional<std::int64_t> partFourEuler;

  [[nodiscard]] std::int64_t sum() const { return interiorIndex + boundaryIndex + triangles; }
  /// The sum is what mesh and reference say.
  [[nodiscard]] bool closes() const;
};

/// The ledger of a mesh by itself. Elements with repeated or missing corners take no part. O(n log n).
IndexLedger indexLedger(const std::vector<Vec3>& positions, const std::vector<Element>& elements);

/// What a mesh is and how good it is. Lengths are in units of the mesh, angles in degrees.
struct QualityReport {
  std::int64_t vertices = 0;
  std::int64_t quads = 0;
  std::int64_t triangles = 0;
  double quadShare = 0.0;  ///< quads / elements; 0 without elements.
  /// Interior vertices with exactly four elements, all quads / interior vertices. Absent when there are none.
  std::optional<double> regularShare;
  std::int64_t interiorVertices = 0;   ///< On no boundary or non-manifold edge, with one fan of elements.
  std::int64_t irregularVertices = 0;  ///< Interior vertices that are not regular.
  std::int64_t doublets = 0;           ///< Interior vertices with only two elements.
  std::int64_t boundaryEdges = 0;
  std::int64_t components = 0;           ///< Connected through vertices.
  std::int64_t eulerCharacteristic = 0;  ///< Vertices - edges + elements, unreferenced vertices excluded.
  IndexLedger ledger;
  double area = 0.0;
  Distribution scaledJacobian;  ///< This and the following ones over the quads.
  Distribution jacobianRatio;
  Distribution jacobianRatioGauss;
  Distribution aspectRatio;
  Distribution edgeRatio;
  Distribution orthogonalQuality;
  Distribution minAngle;
  Distribution maxAngle;
  Distribution skewness;
  Distribution warpage;
  Distribution triangleScaledJacobian;    ///< Over the triangles.
  double size = 0.0;                      ///< The target length that sizeError and the recalls were measured with.
  double sizeError = 0.0;                 ///< Mean |log2(l / size)| over edges.
  std::optional<double> meanDistance;     ///< Of element centres from the reference, weighted by area.
  std::optional<double> largestDistance;  ///< Of vertices and element centres from the reference.
  /// Of the reference from the mesh, at some 2000 of its vertices and 2000 of its triangles' centres, evenly spread.
  std::optional<double> largestGap;
  std::vector<Vec3> missed;                 ///< Those of these that are farther from the mesh than 1.5 target lengths.
  std::optional<double> sharpRecall;        ///< Share of the reference's sharp edge length that the mesh keeps.
  std::optional<double> boundaryRecall;     ///< The same of its boundary. Absent when the reference has none.
  std::optional<double> nonManifoldRecall;  ///< The same of its non-manifold edges.
  std::optional<double> cornerRecall;       ///< Share of the reference's feature corners that have a vertex.
  std::vector<ValidityCheck> checks;
  bool valid = false;  ///< No check failed.
};

struct QualityOptions {
  std::optional<double> size;  ///< Target length, > 0; default: square root of the mean quad area.
  double featureAngle = 30.0;  ///< Degrees; dihedral angle from which an edge of the reference is sharp.
};

/// Measures and validates. reference may be null: then there are no fidelity figures and the checks are those of
/// validateMesh(). With it, defects that the reference has itself are allowed, and there are further checks:
/// "nonManifoldVertices", which fails where the reference has fewer, "boundary", "cracks", "tJunctions", "components",
/// "euler", "indexLedger" (whether the ledger closes with the reference's Euler characteristic), "coverage" (area) and
/// "facesTurnedOver" (against the reference's normals). The reference may be a soup: it is welded by exact position.
/// Complexity O((n + m) log(n + m)).
QualityReport measureQuality(const QuadMesh& mesh, const TriangleMesh* reference, const QualityOptions& options);

}  // namespace qmcf
