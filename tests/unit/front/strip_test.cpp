#include "qmcf/front/strip.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "field/patches.hpp"
#include "front/face_mesh_checks.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/mesh/element_shape.hpp"

namespace qmcf {
namespace {

using testing::expectValid;

std::int64_t triangleCount(const FaceMesh& mesh) {
  return std::count_if(mesh.elements.begin(), mesh.elements.end(),
                       [](const Element& element) { return cornerCount(element) == 3; });
}

/// Cells of size 1 of a plane grid, those that `keep` says of their centres.
Patch cells(int nx, int ny, const std::function<bool(double, double)>& keep) {
  testing::Grid grid;
  grid.nx = nx;
  grid.ny = ny;
  grid.map = [=](double x, double y) { return Vec3{nx * x, ny * y, 0.0}; };
  grid.keep = [=](double x, double y) { return keep(nx * x, ny * y); };
  return testing::makeGrid(grid, 1.0);
}

/// A trapezoid of height 1 between sides of `below` and `above` equal divisions, both `length` long.
Patch strip(int below, int above, double length) {
  std::vector<Vec3> positions;
  for (int i = 0; i <= below; ++i) positions.push_back({length * i / below, 0.0, 0.0});
  for (int i = 0; i <= above; ++i) positions.push_back({length * i / above, 1.0, 0.0});
  testing::Corners triangles;
  for (std::int32_t i = 0, j = 0; i < below || j < above;) {
    const std::int32_t a = i;
    const std::int32_t b = below + 1 + j;
    const bool lower = j == above || (i < below && (i + 1) * above <= (j + 1) * below);
    triangles.push_back({a, lower ? a + 1 : b + 1, b});
    ++(lower ? i : j);
  }
  return testing::makePatch(positions, triangles, length / std::max(below, above));
}

TEST(Strip, MeetsTheNodesOfBothSides) {
  const Patch patch = strip(12, 12, 12.0);
  const auto mesh = meshStrip(patch);
  ASSERT_TRUE(mesh);
  expectValid(*mesh, patch);
  EXPECT_EQ(mesh->elements.size(), 12U);
  EXPECT_NEAR(shapeCost(*mesh), 0.0, 1e-12);
}

TEST(Strip, HasAsFewTrianglesAsTheSidesAllow) {
  // Each triangle takes one division more on one side than on the other; with an even number around they come in pairs.
  for (const int more : {2, 4}) {
    const Patch patch = strip(20, 20 + more, 24.0);
    const auto mesh = meshStrip(patch);
    ASSERT_TRUE(mesh);
    expectValid(*mesh, patch);
    EXPECT_EQ(triangleCount(*mesh), more);
  }
}

/// Between two tips, with `divisions` equal ones on each side; `height` in the middle.
Patch lens(int divisions, double length, double height) {
  std::vector<Vec3> positions;
  for (const double side : {-0.5, 0.5}) {
    for (int i = 0; i <= divisions; ++i) {
      if (side > 0.0 && (i == 0 || i == divisions)) continue;
      const double t = static_cast<double>(i) / divisions;
      positions.push_back({length * t, side * height * 4.0 * t * (1.0 - t), 0.0});
    }
  }
  const auto above = [=](int i) { return i == 0 ? 0 : i == divisions ? divisions : divisions + i; };
  testing::Corners triangles;
  for (std::int32_t i = 0; i < divisions; ++i) {
    if (i > 0) triangles.push_back({i, i + 1, above(i)});
    if (i + 1 < divisions) triangles.push_back({i + 1, above(i + 1), above(i)});
  }
  return testing::makePatch(positions, triangles, length / divisions, 20.0);
}

TEST(Strip, HasATriangleInEachTip) {
  const Patch patch = lens(8, 8.0, 0.4);
  const auto mesh = meshStrip(patch);
  ASSERT_TRUE(mesh);
  expectValid(*mesh, patch);
  EXPECT_EQ(triangleCount(*mesh), 2);
  EXPECT_EQ(mesh->elements.size(), 8U);
  for (const Element& element : mesh->elements) {
    if (cornerCount(element) == 4) {
      EXPECT_GT(elementShape(*mesh, element), 0.9);
    }
  }
}

TEST(ElementShape, DoesNotBlameAnElementForTheOutline) {
  const Patch patch = lens(2, 2.0, 0.3);
  const auto mesh = meshStrip(patch);
  ASSERT_TRUE(mesh);
  // The sides meet at 2 atan(0.15).
  ASSERT_EQ(mesh->elements.size(), 1U);
  const Element& whole = mesh->elements.front();
  const double tip = 2.0 * math::atan2(0.15, 1.0);
  std::array<bool, 4> fills{};
  EXPECT_NEAR(elementShape(*mesh, whole, fills), math::sin(tip), 1e-9);
  fills.fill(true);
  EXPECT_NEAR(elementShape(*mesh, whole, fills), math::sin(math::kPi - tip), 1e-9);
  // Nothing below a sine of 0.1 is taken for a quadrilateral.
  const Patch sharp = lens(2, 2.0, 0.04);
  const auto cut = meshStrip(sharp);
  ASSERT_TRUE(cut);
  EXPECT_EQ(triangleCount(*cut), 2);
}

TEST(Strip, TurnsCornersAndBranches) {
  const auto frame = [](double x, double y) { return x < 1.0 || x > 7.0 || y < 1.0 || y > 5.0; };
  const auto comb = [](double x, double y) { return y < 1.0 || static_cast<int>(x) % 3 == 0; };
  const auto ladder = [](double x, double y) { return y < 1.0 || y > 3.0 || static_cast<int>(x) % 4 == 0; };
  const std::array<std::pair<const char*, Patch>, 3> parts{
      {{"frame", cells(8, 6, frame)}, {"comb", cells(10, 5, comb)}, {"ladder", cells(13, 4, ladder)}}};
  for (const auto& [name, patch] : parts) {
    SCOPED_TRACE(name);
    const auto mesh = meshStrip(patch);
    ASSERT_TRUE(mesh);
    expectValid(*mesh, patch);
    // The cells themselves are the only mesh of squares, and all their vertices are on the boundary.
    EXPECT_EQ(2 * mesh->elements.size(), patch.surface.triangleCount());
    EXPECT_NEAR(shapeCost(*mesh), 0.0, 1e-12);
  }
}

TEST(Strip, GoesAroundTubes) {
  testing::Grid grid;
  grid.nx = 24;
  grid.ny = 1;
  grid.closedX = true;
  grid.map = [](double x, double y) {
    const double angle = 2.0 * math::kPi * x;
    return Vec3{math::cos(angle), math::sin(angle), 0.3 * y};
  };
  const Patch patch = testing::makeGrid(grid, 0.26);
  const auto mesh = meshStrip(patch);
  ASSERT_TRUE(mesh);
  expectValid(*mesh, patch);
  EXPECT_EQ(mesh->elements.size(), 24U);
}

TEST(Strip, LeavesWideAndClosedFacesAlone) {
  EXPECT_FALSE(meshStrip(testing::makeSquare(6)));
  EXPECT_FALSE(meshStrip(testing::makeDisk(6)));
  EXPECT_FALSE(meshStrip(testing::makeSphere(4)));
}

}  // namespace
}  // namespace qmcf
