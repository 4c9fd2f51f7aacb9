#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "qmcf/mesh/edit_mesh.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "qmcf/mesh/face_mesh.hpp"
#include "qmcf/mesh/patch.hpp"

namespace qmcf::testing {

/// Conforming, consistently oriented, same Euler characteristic and boundary as the patch, no element turned over, and
/// the ledger of irregular vertices and triangles closes (A6 of docs/algorithm.md).
inline void expectValid(const FaceMesh& mesh, const Patch& patch) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> directed;
  std::vector<int> elementsAt(mesh.positions.size(), 0);
  std::int64_t triangles = 0;
  for (const Element& element : mesh.elements) {
    const std::size_t corners = cornerCount(element);
    triangles += corners == 3 ? 1 : 0;
    for (std::size_t c = 0; c < corners; ++c) {
      ++directed[{element[c], element[(c + 1) % corners]}];
      ++elementsAt[static_cast<std::size_t>(element[c])];
    }
  }
  std::int64_t borders = 0;
  for (const auto& [edge, uses] : directed) {
    ASSERT_EQ(uses, 1) << "two elements run along an edge in the same direction";
    if (directed.count({edge.second, edge.first}) != 0) continue;
    ++borders;
    const std::int32_t a = mesh.patchVertex[static_cast<std::size_t>(edge.first)];
    const std::int32_t b = mesh.patchVertex[static_cast<std::size_t>(edge.second)];
    ASSERT_NE(a, kNone);
    ASSERT_NE(b, kNone);
    const HalfedgeId h = patch.surface.outgoing(VertexId(a));
    EXPECT_TRUE(patch.surface.isBoundary(h));
    EXPECT_EQ(patch.surface.target(h), VertexId(b));
  }
  std::int64_t patchBorders = 0;
  for (const HalfedgeId h : patch.surface.halfedges()) patchBorders += patch.surface.isBoundary(h) ? 1 : 0;
  EXPECT_EQ(borders, patchBorders);
  const auto edges = (static_cast<std::int64_t>(directed.size()) + borders) / 2;
  const auto chi =
      static_cast<std::int64_t>(mesh.positions.size()) - edges + static_cast<std::int64_t>(mesh.elements.size());
  EXPECT_EQ(chi, patch.surface.eulerCharacteristic());
  std::int64_t ledger = triangles;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    ledger += (mesh.patchVertex[v] == kNone ? 4 : 2) - elementsAt[v];
  EXPECT_EQ(ledger, 4 * chi);
  const EditMesh edit(mesh);
  for (std::size_t f = 0; f < edit.faceCapacity(); ++f) {
    EXPECT_GT(faceShape(edit, FaceId(f)), 0.0) << f << " with " << edit.cornerCount(FaceId(f)) << " corners";
  }
}

/// The same patch with another element size everywhere.
inline Patch withSize(Patch patch, double size) {
  for (const VertexId v : patch.surface.vertices()) patch.size[v] = size;
  return patch;
}

}  // namespace qmcf::testing
