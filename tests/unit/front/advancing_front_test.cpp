#include "qmcf/front/advancing_front.hpp"

#include <gtest/gtest.h>

#include "field/patches.hpp"
#include "front/face_mesh_checks.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/mesh/edit_mesh.hpp"
#include "qmcf/mesh/element_shape.hpp"

namespace qmcf {
namespace {

CrossField fieldOf(const Patch& patch) {
  SilentProgress silent;
  const std::vector<std::uint8_t> kinds(patch.surface.halfedgeCount(), 1);
  auto field = computeCrossField(patch, kinds, FieldOptions{}, silent);
  EXPECT_TRUE(field.ok());
  return std::move(field).value();
}

FrontResult mesh(const Patch& patch) {
  SilentProgress silent;
  auto result = advanceFront(patch, fieldOf(patch), FrontOptions{}, silent);
  EXPECT_TRUE(result.ok());
  return std::move(result).value();
}

using testing::expectValid;
using testing::withSize;

TEST(AdvancingFront, MakesTheGridOfASquare) {
  // A square whose sides have ten divisions has a perfect mesh, and rows from its sides must find it.
  Patch patch = testing::makeSquare(10);
  const FrontResult result = mesh(patch);
  expectValid(result.mesh, patch);
  EXPECT_EQ(result.statistics.triangles, 0);
  EXPECT_EQ(result.statistics.quads, 100);
  const EditMesh edit(result.mesh);
  for (std::size_t f = 0; f < edit.faceCapacity(); ++f) EXPECT_GT(faceShape(edit, FaceId(f)), 0.9);
}

TEST(AdvancingFront, FollowsTheSizeAndNotTheBackground) {
  // Elements of the size asked for, whatever the triangles are like.
  const Patch fine = withSize(testing::makeSquare(16), 0.0625);
  const FrontResult result = mesh(fine);
  expectValid(result.mesh, fine);
  EXPECT_NEAR(static_cast<double>(result.statistics.quads), 256.0, 26.0);
}

TEST(AdvancingFront, MeshesADiskWithFewTriangles) {
  const Patch patch = testing::makeDisk(12);
  const FrontResult result = mesh(patch);
  expectValid(result.mesh, patch);
  EXPECT_LE(result.statistics.triangles, result.statistics.quads / 25);
}

TEST(AdvancingFront, MeshesRingsTubesAndClosedSurfaces) {
  const std::array<std::pair<const char*, Patch>, 5> parts{
      {{"pentagonal ring", testing::makePolygonRing(5, 8, 6, false)},
       {"hexagon, round hole", withSize(testing::makePolygonRing(6, 10, 8, true), 0.07)},
       {"tube", testing::makeCylinder(24, 12, 3.0)},
       {"sphere", testing::makeSphere(8)},
       {"torus", withSize(testing::makeTorus(40, 16), 0.16)}}};
  for (const auto& [name, patch] : parts) {
    SCOPED_TRACE(name);
    const FrontResult result = mesh(patch);
    expectValid(result.mesh, patch);
    EXPECT_GE(10 * result.statistics.quads, 8 * (result.statistics.quads + result.statistics.triangles));
  }
}

TEST(AdvancingFront, PlacesPatternsAtSingularities) {
  const Patch patch = testing::makeDisk(16);
  SilentProgress silent;
  const CrossField field = fieldOf(patch);
  ASSERT_EQ(field.singularities.size(), 4U);
  auto with = advanceFront(patch, field, FrontOptions{}, silent);
  FrontOptions plain;
  plain.patterns = false;
  auto without = advanceFront(patch, field, plain, silent);
  EXPECT_GT(with.value().statistics.stars, 0);
  EXPECT_EQ(without.value().statistics.stars, 0);
  expectValid(with.value().mesh, patch);
  expectValid(without.value().mesh, patch);
}

TEST(AdvancingFront, SurvivesPatchesTooSmallToMesh) {
  for (int cells = 1; cells <= 3; ++cells) {
    const Patch patch = testing::makeSquare(cells);
    expectValid(mesh(patch).mesh, patch);
    expectValid(recombinePatch(patch).mesh, patch);
  }
}

TEST(AdvancingFront, ClosesNarrowFacesToTheirEnd) {
  // A band of one row whose quads are too short for the first pass: each has to wait for a desperate one, and would try
  // again whenever any other is made.
  constexpr int kAround = 200;
  testing::Grid grid;
  grid.nx = kAround;
  grid.ny = 1;
  grid.closedX = true;
  grid.map = [](double x, double y) {
    const double angle = 2.0 * math::kPi * x;
    return Vec3{math::cos(angle), math::sin(angle), 2.0 * math::kPi / kAround * y};
  };
  const Patch patch = testing::makeGrid(grid, 3.4 * 2.0 * math::kPi / kAround);
  const FrontResult result = mesh(patch);
  expectValid(result.mesh, patch);
  EXPECT_EQ(result.statistics.recombined, 0);
  EXPECT_GE(result.statistics.quads, kAround - 4);
  EXPECT_LT(result.statistics.rollbacks, 300 * kAround);
}

TEST(AdvancingFront, GivesTheSameMeshEachTime) {
  const Patch patch = testing::makeDisk(9);
  const FrontResult first = mesh(patch);
  const FrontResult second = mesh(patch);
  EXPECT_EQ(first.mesh.elements, second.mesh.elements);
  EXPECT_TRUE(first.mesh.positions == second.mesh.positions);
}

TEST(AdvancingFront, StopsWhenAsked) {
  class Stop final : public Progress {
   public:
    [[nodiscard]] bool report(Stage, double) override { return false; }
  };
  const Patch patch = testing::makeSquare(10);
  Stop stop;
  const auto result = advanceFront(patch, fieldOf(patch), FrontOptions{}, stop);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace qmcf
