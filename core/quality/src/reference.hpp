#pragma once

#include <cstdint>
#include <vector>

#include "qmcf/mesh/triangle_mesh.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"
#include "seams.hpp"
#include "segment_grid.hpp"
#include "structure.hpp"

namespace qmcf::quality {

/// The triangle mesh that a quad mesh is measured against, welded by exact position.
struct Reference {
  std::vector<Vec3> positions;
  std::vector<Element> triangles;  ///< Those with three different welded vertices.
  std::vector<Vec3> normals;       ///< Unit; zero for slivers, whose normals mean nothing.
  Structure structure;
  Seams seams;
  double diagonal = 0.0;  ///< Of the bounding box.
  double area = 0.0;
  bool oriented = true;                   ///< Neighbours agree about the surface's side everywhere.
  TriangleBvh bvh;                        ///< Over the triangles that are no slivers.
  std::vector<std::int32_t> bvhTriangle;  ///< Per triangle of the tree: triangle of the reference.

  [[nodiscard]] bool isSliver(std::int32_t triangle) const {
    return squaredNorm(normals[static_cast<std::size_t>(triangle)]) == 0.0;
  }
  [[nodiscard]] bool isClosed() const { return structure.boundaryLength == 0.0; }
};

/// Triangles with indices out of range or non-finite corners are left out.
Reference buildReference(const TriangleMesh& mesh);

/// The lines and points of a reference that a mesh has to keep.
struct ReferenceFeatures {
  std::vector<Segment> sharp;
  std::vector<Segment> boundary;
  std::vector<Segment> nonManifold;
  std::vector<Vec3> corners;  ///< Where other than two such edges meet, or two that turn by more than 45 degrees.
};

/// featureAngle in degrees.
ReferenceFeatures findFeatures(const Reference& reference, double featureAngle);

}  // namespace qmcf::quality
