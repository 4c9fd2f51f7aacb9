#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/ids.hpp"

namespace qmcf {

/// A quadrilateral (four vertices) or triangle (the fourth is kNone), counter-clockwise.
using Element = std::array<std::int32_t, 4>;

/// Number of corners of an element: 3 or 4.
constexpr std::size_t cornerCount(const Element& element) { return element[3] == kNone ? 3 : 4; }

/// An edge of the mesh that lies on an edge of the B-rep.
struct FeatureSegment {
  std::int32_t a = kNone;     ///< Vertex.
  std::int32_t b = kNone;     ///< Vertex.
  std::int32_t edge = kNone;  ///< Edge of the B-rep.
};

/// A quad-dominant mesh.
struct QuadMesh {
  std::vector<Vec3> positions;
  std::vector<Element> elements;
  std::vector<std::int32_t> elementFace;        ///< Per element: face of the B-rep.
  std::vector<FeatureSegment> featureSegments;  ///< Edges on sharp, boundary, non-manifold and user edges.
};

}  // namespace qmcf
