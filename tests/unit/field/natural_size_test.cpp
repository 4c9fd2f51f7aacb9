#include "qmcf/field/natural_size.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "field/patches.hpp"
#include "field/solve.hpp"

namespace qmcf {
namespace {

using testing::solve;

std::vector<IdMap<VertexId, double>> sizesOf(const std::vector<Patch>& patches) {
  SilentProgress progress;
  std::vector<CrossField> fields;
  for (const Patch& patch : patches) fields.push_back(solve(patch));
  auto sizes = naturalSizes(patches, fields, progress);
  EXPECT_TRUE(sizes.ok());
  return std::move(sizes).value();
}

double radiusOf(const Patch& patch, VertexId v) { return norm(patch.surface.position(v)); }

/// The sector of a ring with these radii, 90 degrees wide.
Patch makeSector(double inner, double outer, int along, int across) {
  const auto map = [=](double x, double y) {
    const double angle = 0.5 * std::numbers::pi * (1.0 - x);
    const double r = inner + (outer - inner) * y;
    return Vec3{r * std::cos(angle), r * std::sin(angle), 0.0};
  };
  testing::Grid grid;
  grid.nx = along;
  grid.ny = across;
  grid.map = map;
  return testing::makeGrid(grid, 0.05);
}

TEST(NaturalSize, IsTheSameEverywhereWhereTheFieldDoesNotTurn) {
  const std::vector<Patch> patches{testing::makeSquare(8), testing::makeCylinder(24, 6, 1.0)};
  for (const Patch& patch : patches) {
    const auto sizes = sizesOf({patch});
    for (const double size : sizes[0].raw()) EXPECT_NEAR(size, 0.0, 1e-9);
  }
}

TEST(NaturalSize, GrowsWithTheRadiusOfABend) {
  // Squares between circles and rays are as long as they are far from the middle.
  const Patch sector = makeSector(1.0, 2.0, 30, 20);
  const auto sizes = sizesOf({sector});
  const double offset = sizes[0][VertexId(0)] - std::log(radiusOf(sector, VertexId(0)));
  for (std::size_t v = 0; v < sector.surface.vertexCount(); ++v) {
    EXPECT_NEAR(sizes[0][VertexId(v)], std::log(radiusOf(sector, VertexId(v))) + offset, 0.015);
  }
}

TEST(NaturalSize, IsSharedByFacesAlongTheirEdges) {
  Patch inner = makeSector(1.0, 1.5, 30, 10);
  Patch outer = makeSector(1.5, 2.0, 30, 10);
  // Equal places have equal nodes, as on edges of the B-rep.
  std::map<std::pair<double, double>, std::int32_t> nodes;
  for (Patch* const patch : {&inner, &outer}) {
    for (std::size_t i = 0; i < patch->node.size(); ++i) {
      const VertexId v(i);
      if (patch->node[v] == kNone) continue;
      const Vec3& p = patch->surface.position(v);
      const auto rounded = std::pair(std::round(p.x * 1e6), std::round(p.y * 1e6));
      patch->node[v] = nodes.try_emplace(rounded, static_cast<std::int32_t>(nodes.size())).first->second;
    }
  }
  const std::vector<Patch> patches{inner, outer};
  const auto sizes = sizesOf(patches);
  const double offset = sizes[0][VertexId(0)] - std::log(radiusOf(inner, VertexId(0)));
  for (std::size_t p = 0; p < 2; ++p) {
    for (std::size_t v = 0; v < patches[p].surface.vertexCount(); ++v) {
      EXPECT_NEAR(sizes[p][VertexId(v)], std::log(radiusOf(patches[p], VertexId(v))) + offset, 0.015);
    }
  }
}

TEST(NaturalSize, LeavesNoRowToEndInABend) {
  SilentProgress progress;
  const Patch sector = makeSector(1.0, 2.0, 60, 40);
  const std::vector<CrossField> fields{solve(sector)};
  const std::vector<Patch> patches{sector};
  // Of rows with one size across the bend, those that the outer arc is longer by end: 90 degrees of the radii's
  // difference.
  const std::vector<IdMap<VertexId, double>> even{IdMap<VertexId, double>(sector.surface.vertexCount(), 0.0)};
  const double ends = 0.5 * std::numbers::pi / 0.05;
  EXPECT_NEAR(expectedRowEnds(patches, fields, even), ends, 0.01 * ends);
  EXPECT_LT(expectedRowEnds(patches, fields, sizesOf(patches)), 0.05 * ends);
  // Where sizes grow along a field that does not turn, rows end as well: the width of a square times the change of 1/h.
  Patch square = testing::makeSquare(16);
  std::vector<IdMap<VertexId, double>> growing{IdMap<VertexId, double>(square.surface.vertexCount(), 0.0)};
  for (std::size_t v = 0; v < square.surface.vertexCount(); ++v) {
    growing[0][VertexId(v)] = 0.1 * square.surface.position(VertexId(v)).x;
  }
  const double size = square.size[VertexId(0)];
  EXPECT_NEAR(expectedRowEnds({square}, {solve(square)}, growing), 0.1 / size, 1e-6 / size);
  EXPECT_EQ(expectedRowEnds(patches, {CrossField{}}, even), 0.0);
}

TEST(NaturalSize, AsksForNothingWhereThereIsNoField) {
  SilentProgress progress;
  const std::vector<Patch> patches{makeSector(1.0, 2.0, 12, 8)};
  const auto sizes = naturalSizes(patches, {CrossField{}}, progress);
  ASSERT_TRUE(sizes.ok());
  for (const double size : sizes.value()[0].raw()) EXPECT_NEAR(size, 0.0, 1e-12);
}

}  // namespace
}  // namespace qmcf
