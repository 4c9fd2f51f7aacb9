#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "qmcf/mesh/quad_mesh.hpp"
#include "reference.hpp"
#include "structure.hpp"

namespace qmcf::quality {

/// A quad mesh with what its measurements share.
struct MeasuredMesh {
  const QuadMesh& mesh;
  const std::vector<std::uint8_t>& usable;  ///< Per element.
  const Structure& structure;
  const std::vector<Vec3>& centres;  ///< Per element: the mean of its corners.
  const std::vector<double>& areas;  ///< Per element.
};

/// Where the reference is closest to each element's centre; of no meaning for unusable elements.
/// \pre the reference's tree is not empty
std::vector<ClosestPoint> projectCentres(const MeasuredMesh& measured, const Reference& reference);

/// How far the mesh and the reference are from each other. \pre the reference's tree is not empty
struct Distances {
  double mean = 0.0;        ///< Of element centres from the reference, weighted by area.
  double largest = 0.0;     ///< Of vertices and element centres from the reference.
  double largestGap = 0.0;  ///< Of the reference's vertices and triangle centres from the mesh, a few thousand at most.
  std::vector<Vec3> missed;  ///< Those of them that are farther than `far`.
};
Distances measureDistances(const MeasuredMesh& measured, const Reference& reference,
                           const std::vector<ClosestPoint>& projected, double far);

/// Elements with a corner whose normal opposes the reference's surface near it: the triangle closest to the element's
/// centre, and all triangles of the patch under the corner, so that elements that meet a sharp edge don't count.
/// \pre the reference's tree is not empty
std::vector<std::int64_t> findTurnedOver(const MeasuredMesh& measured, const Reference& reference,
                                         const std::vector<ClosestPoint>& projected);

/// Shares of the reference's features that the mesh keeps, by length, 1 best; absent where the reference has none.
/// A piece of a feature edge is kept when an edge of the mesh passes within 0.1 size of its middle at less than 25
/// degrees, a corner when a vertex is within 0.1 size.
struct Recall {
  std::optional<double> sharp;
  std::optional<double> boundary;
  std::optional<double> nonManifold;
  std::optional<double> corner;
};
Recall measureRecall(const MeasuredMesh& measured, const ReferenceFeatures& features, double size);

}  // namespace qmcf::quality
