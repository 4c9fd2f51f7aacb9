#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "qmcf/base/result.hpp"
#include "qmcf/mesh/quad_mesh.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"

namespace qmcf {

/// Mean, worst and quantiles of one metric over the elements.
struct Distribution {
  double mean = 0.0;
  double worst = 0.0;
  double p1 = 0.0;      ///< The quantile below (or, for ratios >= 1, above) which the worst 1 % lie.
  double median = 0.0;
};

/// Shape of one quadrilateral. Definitions and sources: section F of docs/algorithm.md.
struct QuadMetrics {
  double scaledJacobian = 0.0;      ///< min over corners, in [-1, 1], 1 best (Verdict).
  double jacobianRatio = 0.0;       ///< max / min at the corners, >= 1, 1 best (ANSYS, MAPDL form); infinite if inverted.
  double jacobianRatioGauss = 0.0;  ///< The same at the 2 x 2 Gauss points.
  double aspectRatio = 0.0;         ///< ANSYS rectangles, >= 1, 1 best.
  double edgeRatio = 0.0;           ///< Longest over shortest edge.
  double orthogonalQuality = 0.0;   ///< In [-1, 1], 1 best.
  double minAngle = 0.0;            ///< Degrees.
  double maxAngle = 0.0;            ///< Degrees; above 180 at an inverted corner.
  double skewness = 0.0;            ///< Equiangle, in [0, 1], 0 best.
  double warpage = 0.0;             ///< Degrees between the normals across a diagonal, larger of the two.
};
QuadMetrics quadMetrics(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// Scaled Jacobian of a triangle, 1 for the equilateral one.
double triangleScaledJacobian(const Vec3& a, const Vec3& b, const Vec3& c);

/// One check of the validator.
struct ValidityCheck {
  std::string name;
  std::int64_t count = 0;              ///< Defects found; 0 passes.
  std::vector<std::int64_t> elements;  ///< At most 100 element or vertex ids, as the sentence says.
  std::string sentence;                ///< For a person; empty when passed.
};

/// What a mesh is and how good it is.
struct QualityReport {
  std::int64_t vertices = 0;
  std::int64_t quads = 0;
  std::int64_t triangles = 0;
  double quadShare = 0.0;              ///< quads / elements.
  double regularShare = 0.0;           ///< Interior vertices with four elements / interior vertices.
  std::int64_t irregularVertices = 0;
  std::int64_t boundaryEdges = 0;
  std::int64_t eulerCharacteristic = 0;
  Distribution scaledJacobian;
  Distribution jacobianRatio;
  Distribution jacobianRatioGauss;
  Distribution aspectRatio;
  Distribution edgeRatio;
  Distribution orthogonalQuality;
  Distribution minAngle;
  Distribution maxAngle;
  Distribution skewness;
  Distribution warpage;
  double sizeError = 0.0;              ///< Mean |log2(l / h)| over edges, when a size is known.
  std::optional<double> largestDistance;      ///< Of vertices and element centres from the reference, in its units.
  std::optional<double> sharpRecall;          ///< Share of the reference's sharp edge length that the mesh keeps.
  std::optional<double> boundaryRecall;
  std::optional<double> cornerRecall;
  std::vector<ValidityCheck> checks;
  bool valid = false;
};

/// Structural checks of a mesh alone: indices, finite coordinates, repeated corners, duplicate elements, manifold edges
/// (other than those that lie on featureSegments or in `reference` as non-manifold), orientation, inverted elements.
struct QualityOptions {
  std::optional<double> size;       ///< Target length for sizeError; default: square root of the mean quad area.
  double featureAngle = 30.0;       ///< Degrees; for the reference's sharp edges.
};

/// Measures and validates. reference may be null: then there are no fidelity figures.
QualityReport measureQuality(const QuadMesh& mesh, const TriangleMesh* reference, const QualityOptions& options);

}  // namespace qmcf
