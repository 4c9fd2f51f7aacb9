#include "qmcf/qmorph/qmorph.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "field/patches.hpp"
#include "front/face_mesh_checks.hpp"
#include "qmcf/spatial/surface_tree.hpp"

namespace qmcf {
namespace {

using testing::expectValid;
using testing::withSize;

MorphResult mesh(const Patch& patch) {
  SilentProgress silent;
  auto result = advanceMorph(patch, surfaceTree(patch.surface), MorphOptions{}, silent);
  EXPECT_TRUE(result.ok());
  return std::move(result).value();
}

/// The unit square without a quarter: one reflex corner.
Patch makeEll(int cells) {
  testing::Grid grid;
  grid.nx = cells;
  grid.ny = cells;
  grid.map = [](double x, double y) { return Vec3{x, y, 0.0}; };
  grid.keep = [](double x, double y) { return x < 0.5 || y < 0.5; };
  return testing::makeGrid(grid, 1.0 / cells);
}

/// An equilateral triangulation of a strip, sheared at the ends: no edge of it is at right angles to its long sides.
Patch makeEquilateralStrip(int along, int rows) {
  testing::Corners triangles;
  std::vector<Vec3> positions;
  const double height = std::sqrt(0.75);
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= along; ++i) positions.push_back({i + 0.5 * j, height * j, 0.0});
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < along; ++i) {
      const int a = j * (along + 1) + i;
      const int d = a + along + 1;
      triangles.push_back({a, a + 1, d});
      triangles.push_back({a + 1, d + 1, d});
    }
  }
  return testing::makePatch(positions, triangles, 1.0);
}

TEST(QMorph, FindsTheGridThatIsInTheTriangles) {
  // The edges of the cells are side and top edges; only the diagonals have to go.
  const Patch patch = testing::makeSquare(10);
  const MorphResult result = mesh(patch);
  expectValid(result.mesh, patch);
  EXPECT_EQ(result.statistics.triangles, 0);
  EXPECT_EQ(result.statistics.quads, 100);
  EXPECT_EQ(result.statistics.splits, 0);
  const EditMesh edit(result.mesh);
  for (std::size_t f = 0; f < edit.faceCapacity(); ++f) EXPECT_GT(faceShape(edit, FaceId(f)), 0.99);
}

TEST(QMorph, MakesSideEdgesWhereTheTrianglesHaveNone) {
  const Patch patch = makeEquilateralStrip(14, 8);
  const MorphResult result = mesh(patch);
  expectValid(result.mesh, patch);
  EXPECT_EQ(result.statistics.triangles, 0);
  EXPECT_GT(result.statistics.swaps + result.statistics.splits, 0);
}

TEST(QMorph, MeshesPlanarDomainsWithQuads) {
  // Each has an even number of boundary edges, so a mesh of quads exists, and parity is kept at every closure. A loop
  // of four edges that are no quad may be left at the end.
  const std::array<std::pair<const char*, Patch>, 5> parts{
      {{"disk", testing::makeDisk(12)},
       {"small disk", testing::makeDisk(5)},
       {"L", makeEll(16)},
       {"pentagonal ring", testing::makePolygonRing(5, 8, 6, false)},
       {"hexagon, round hole", testing::makePolygonRing(6, 10, 8, true)}}};
  for (const auto& [name, patch] : parts) {
    SCOPED_TRACE(name);
    const MorphResult result = mesh(patch);
    expectValid(result.mesh, patch);
    EXPECT_EQ(result.statistics.triangles % 2, 0);
    EXPECT_LE(result.statistics.triangles, result.statistics.quads / 10);
    EXPECT_GT(4 * result.statistics.quads, static_cast<std::int64_t>(patch.surface.triangleCount()));
  }
}

TEST(QMorph, LeavesOneTriangleWhereTheBoundaryIsOdd) {
  // 21 boundary edges: no mesh of quads exists.
  testing::Corners triangles;
  std::vector<Vec3> positions;
  for (int j = 0; j <= 7; ++j) {
    for (int i = 0; i + j <= 7; ++i) positions.push_back({i + 0.5 * j, std::sqrt(0.75) * j, 0.0});
  }
  int row = 0;
  for (int j = 0; j < 7; ++j) {
    const int next = row + 8 - j;
    for (int i = 0; i + j < 7; ++i) {
      triangles.push_back({row + i, row + i + 1, next + i});
      if (i + j < 6) triangles.push_back({row + i + 1, next + i + 1, next + i});
    }
    row = next;
  }
  const Patch patch = testing::makePatch(positions, triangles, 1.0);
  const MorphResult result = mesh(patch);
  expectValid(result.mesh, patch);
  EXPECT_EQ(result.statistics.triangles % 2, 1);
  EXPECT_LE(result.statistics.triangles, 3);
}

TEST(QMorph, StaysOnCurvedAndClosedSurfaces) {
  const std::array<std::pair<const char*, Patch>, 3> parts{{{"tube", testing::makeCylinder(24, 12, 3.0)},
                                                            {"sphere", testing::makeSphere(8)},
                                                            {"torus", withSize(testing::makeTorus(40, 16), 0.16)}}};
  for (const auto& [name, patch] : parts) {
    SCOPED_TRACE(name);
    const MorphResult result = mesh(patch);
    expectValid(result.mesh, patch);
    EXPECT_GE(20 * result.statistics.quads, 19 * (result.statistics.quads + result.statistics.triangles));
    const TriangleBvh tree = surfaceTree(patch.surface);
    for (const Vec3& p : result.mesh.positions) EXPECT_LT(tree.closest(p).squaredDistance, 1e-20);
  }
}

TEST(QMorph, PutsNodesOnThePartAndNotOnItsTriangulation) {
  // The part is a finer sphere than the patch; both have the patch's vertices.
  const Patch patch = testing::makeSphere(8);
  const TriangleBvh part = surfaceTree(testing::makeSphere(32).surface);
  SilentProgress silent;
  const auto result = advanceMorph(patch, part, MorphOptions{}, silent);
  ASSERT_TRUE(result.ok());
  expectValid(result.value().mesh, patch);
  for (const Vec3& p : result.value().mesh.positions) {
    EXPECT_LT(part.closest(p).squaredDistance, 1e-20);
    EXPECT_NEAR(norm(p), 1.0, 2e-3);  // facets of the patch are about 1e-2 inside
  }
}

TEST(QMorph, PassesFromLongEdgesToShortOnes) {
  // The edges of the round hole are half as long as those of the hexagon, so rows that meet differ in length.
  const Patch patch = testing::makePolygonRing(6, 10, 8, true);
  const MorphResult result = mesh(patch);
  expectValid(result.mesh, patch);
  EXPECT_GT(result.statistics.transitions, 0);
}

TEST(QMorph, SurvivesPatchesTooSmallToMesh) {
  for (int cells = 1; cells <= 3; ++cells) {
    const Patch patch = testing::makeSquare(cells);
    expectValid(mesh(patch).mesh, patch);
  }
}

TEST(QMorph, GivesTheSameMeshEachTime) {
  const Patch patch = testing::makeDisk(9);
  const MorphResult first = mesh(patch);
  const MorphResult second = mesh(patch);
  EXPECT_EQ(first.mesh.elements, second.mesh.elements);
  EXPECT_TRUE(first.mesh.positions == second.mesh.positions);
}

TEST(QMorph, StopsWhenAsked) {
  class Stop final : public Progress {
   public:
    [[nodiscard]] bool report(Stage, double) override { return false; }
  };
  Stop stop;
  const Patch patch = testing::makeSquare(6);
  const auto result = advanceMorph(patch, surfaceTree(patch.surface), MorphOptions{}, stop);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace qmcf
