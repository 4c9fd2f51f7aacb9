#include "qmcf/topology/statistics.hpp"

#include <gtest/gtest.h>

#include "topology/shapes.hpp"

namespace qmcf {
namespace {

TEST(Statistics, CountsClosedSurfaces) {
  const MeshStatistics torus = meshStatistics(shapes::torus(20, 10, 3.0, 1.0));
  EXPECT_EQ(torus.vertices, 200);
  EXPECT_EQ(torus.triangles, 400);
  EXPECT_EQ(torus.components, 1);
  EXPECT_EQ(torus.eulerCharacteristic, 0);
  EXPECT_EQ(torus.boundaryEdges, 0);
  EXPECT_EQ(torus.boundaryLoops, 0);
  EXPECT_EQ(torus.nonManifoldEdges + torus.nonManifoldVertices + torus.misorientedEdges, 0);
  EXPECT_EQ(meshStatistics(shapes::cylinder(12, 3, 2.0)).eulerCharacteristic, 2);
}

TEST(Statistics, SheetsThatDoNotShareVerticesAreComponents) {
  const MeshStatistics cube = meshStatistics(shapes::cubeSoup(2));
  EXPECT_EQ(cube.components, 6);
  EXPECT_EQ(cube.boundaryLoops, 6);
  EXPECT_EQ(cube.boundaryEdges, 6 * 8);
  EXPECT_EQ(cube.duplicateVertices, 6 * 9 - 26);
}

TEST(Statistics, ListOfTrianglesIsCountedAsWelded) {
  TriangleMesh list;
  const TriangleMesh cube = shapes::cubeSoup(2);
  for (const auto& c : cube.triangles) {
    const auto n = static_cast<std::int32_t>(list.positions.size());
    for (const std::int32_t v : c) list.positions.push_back(cube.positions[std::size_t(v)]);
    list.triangles.push_back({n, n + 1, n + 2});
  }
  const MeshStatistics statistics = meshStatistics(list);
  EXPECT_EQ(statistics.vertices, 26);
  EXPECT_EQ(statistics.components, 1);
  EXPECT_EQ(statistics.eulerCharacteristic, 2);
  EXPECT_EQ(statistics.duplicateVertices, 0);
}

TEST(Statistics, CountsEachDefect) {
  TriangleMesh mesh = shapes::square(4);
  mesh.positions.push_back({5.0, 5.0, 0.0});
  mesh.triangles.push_back({3, 3, 4});
  mesh.triangles.push_back(mesh.triangles[0]);
  std::swap(mesh.triangles[11][0], mesh.triangles[11][1]);
  const MeshStatistics statistics = meshStatistics(mesh);
  EXPECT_EQ(statistics.unusedVertices, 1);
  EXPECT_EQ(statistics.degenerateTriangles, 1);
  EXPECT_EQ(statistics.duplicateTriangles, 1);
  // The doubled triangle has two inner edges and one on the boundary: its copy makes that one two-sided.
  EXPECT_EQ(statistics.nonManifoldEdges, 2);
  EXPECT_EQ(statistics.boundaryEdges, 15);
  // Three edges of the turned triangle, and the one that the two equal triangles run along alike.
  EXPECT_EQ(statistics.misorientedEdges, 4);
}

TEST(Statistics, TouchingFansAreNonManifoldVertices) {
  TriangleMesh bowTie;
  bowTie.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  bowTie.triangles = {{0, 1, 2}, {0, 3, 4}};
  const MeshStatistics statistics = meshStatistics(bowTie);
  EXPECT_EQ(statistics.nonManifoldVertices, 1);
  EXPECT_EQ(statistics.components, 1);
  EXPECT_EQ(statistics.nonManifoldEdges, 0);
}

}  // namespace
}  // namespace qmcf
