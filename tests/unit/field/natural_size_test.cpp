#include "qmcf/field/natural_size.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "field/patches.hpp"
#include "field/solve.hpp"

namespace qmcf {
namespace {

using testing::solve;

template <class T>
T valueOf(Result<T> result) {
  EXPECT_TRUE(result.ok());
  return std::move(result).value();
}

std::vector<IdMap<VertexId, double>> sizesOf(const std::vector<Patch>& patches) {
  SilentProgress progress;
  std::vector<CrossField> fields;
  for (const Patch& patch : patches) fields.push_back(solve(patch));
  return valueOf(naturalSizes(patches, fields, progress));
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

IdMap<VertexId, double> spread(const Patch& patch) {
  SilentProgress progress;
  return valueOf(spreadSizes(patch, progress));
}

IdMap<VertexId, double> turned(const Patch& patch, const CrossField& field) {
  SilentProgress progress;
  return valueOf(turnedSizes(patch, field, progress));
}

TEST(SpreadSizes, KeepWhatRowsCanFollowAlready) {
  const Patch square = testing::makeSquare(12);
  const IdMap<VertexId, double> even = spread(square);
  for (const VertexId v : square.surface.vertices()) EXPECT_EQ(even[v], square.size[v]);
  // log r is harmonic.
  Patch sector = makeSector(1.0, 2.0, 60, 40);
  for (const VertexId v : sector.surface.vertices()) sector.size[v] = 0.04 * radiusOf(sector, v);
  const IdMap<VertexId, double> growing = spread(sector);
  for (const VertexId v : sector.surface.vertices()) EXPECT_NEAR(growing[v] / sector.size[v], 1.0, 2e-3);
}

TEST(SpreadSizes, GoBackToThoseWantedWithinFourElements) {
  // A square whose edges have half the size wanted inside: far from the corners a function of the distance alone.
  constexpr double kInside = 0.02;
  Patch square = testing::makeSquare(60);
  for (const VertexId v : square.surface.vertices()) square.size[v] = square.surface.isBoundary(v) ? 0.01 : kInside;
  const IdMap<VertexId, double> sizes = spread(square);
  const double reach = 4.0 * kInside;
  for (const VertexId v : square.surface.vertices()) {
    if (square.surface.isBoundary(v)) {
      EXPECT_EQ(sizes[v], square.size[v]);
      continue;
    }
    EXPECT_GT(sizes[v], 0.01);
    EXPECT_LT(sizes[v], kInside);
    const Vec3& p = square.surface.position(v);
    if (std::fabs(p.x - 0.5) > 0.1) continue;
    const double log = -std::log(2.0) * std::cosh((p.y - 0.5) / reach) / std::cosh(0.5 / reach);
    EXPECT_NEAR(std::log(sizes[v] / kInside), log, 0.02) << p.y;
  }
}

TEST(TurnedSizes, StayWhereTheFieldDoesNotTurn) {
  const Patch square = testing::makeSquare(12);
  const IdMap<VertexId, double> straight = turned(square, solve(square));
  for (const VertexId v : square.surface.vertices()) EXPECT_NEAR(straight[v], square.size[v], 1e-12);
  const Patch sphere = testing::makeSphere(8);
  const IdMap<VertexId, double> unasked = turned(sphere, CrossField{});
  for (const VertexId v : sphere.surface.vertices()) EXPECT_NEAR(unasked[v], sphere.size[v], 1e-12);
}

TEST(TurnedSizes, AreSmallestAroundPositiveSingularities) {
  const Patch sphere = testing::makeSphere(16);
  const CrossField field = solve(sphere);
  ASSERT_EQ(field.singularities.size(), 8U);
  const IdMap<VertexId, double> sizes = turned(sphere, field);
  double least = 1e9;
  double most = 0.0;
  for (const VertexId v : sphere.surface.vertices()) {
    const double ratio = sizes[v] / sphere.size[v];
    EXPECT_LE(std::fabs(std::log(ratio)), 0.3);
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  EXPECT_GT(most / least, 1.2);
  for (const Singularity& singularity : field.singularities) {
    for (const VertexId v : sphere.surface.corners(singularity.point.triangle)) {
      EXPECT_LT(sizes[v] / sphere.size[v], least * std::sqrt(most / least));
    }
  }
}

IdMap<VertexId, double> madeSizes(const Patch& patch, const FaceMesh& mesh) {
  SilentProgress progress;
  return valueOf(sizesOfMesh(patch, mesh, progress));
}

TEST(SizedEdges, TellTheLengthOfEachEdgeOnce) {
  const Patch patch = testing::makeSquare(8);
  const FaceMesh mesh = trianglesOf(patch);
  const std::vector<SizedEdge> edges = sizedEdges(patch, mesh);
  // Euler's formula for a disc.
  EXPECT_EQ(edges.size(), mesh.positions.size() + mesh.elements.size() - 1);
  for (const SizedEdge& edge : edges) {
    const double length = distance(mesh.positions[static_cast<std::size_t>(edge.ends[0])],
                                   mesh.positions[static_cast<std::size_t>(edge.ends[1])]);
    EXPECT_NEAR(edge.size * std::exp(edge.log), length, 1e-12);
  }
}

TEST(SizesOfMesh, ComeNearItsEdgesButForTheBoundary) {
  const Patch square = testing::makeSquare(40);
  const FaceMesh mesh = trianglesOf(square);
  double mean = 0.0;
  const std::vector<SizedEdge> edges = sizedEdges(square, mesh);
  for (const SizedEdge& edge : edges) mean += edge.log / static_cast<double>(edges.size());
  // Sizes that are 0.2 off the triangulation's edges, in logarithms, are as long as these in the middle.
  for (const double off : {-0.2, 0.2}) {
    Patch patch = square;
    for (double& size : patch.size.raw()) size *= std::exp(mean + off);
    const auto made = madeSizes(patch, mesh);
    const double expected = -0.3 * std::tanh(off / 0.3);
    for (const VertexId v : patch.surface.vertices()) {
      const Vec3& p = patch.surface.position(v);
      const double change = std::log(made[v] / patch.size[v]);
      if (patch.surface.isBoundary(v)) {
        EXPECT_EQ(made[v], patch.size[v]);
      } else if (std::max(std::fabs(p.x - 0.5), std::fabs(p.y - 0.5)) < 0.3) {
        EXPECT_NEAR(change, expected, 0.03);
      }
    }
  }
}

TEST(SizesOfMesh, FollowOnlyWhatVariesWithoutABoundary) {
  Patch sphere = testing::makeSphere(12);
  const FaceMesh mesh = trianglesOf(sphere);
  const auto once = madeSizes(sphere, mesh);
  for (double& size : sphere.size.raw()) size *= 3.0;
  const auto larger = madeSizes(sphere, mesh);
  double mean = 0.0;
  for (const VertexId v : sphere.surface.vertices()) {
    EXPECT_NEAR(larger[v], 3.0 * once[v], 0.05 * larger[v]);
    mean += std::log(larger[v] / sphere.size[v]) / static_cast<double>(sphere.surface.vertexCount());
  }
  EXPECT_NEAR(mean, 0.0, 0.05);
}

TEST(SpreadSizes, DoNotDependOnTheUnitOfLength) {
  Patch square = testing::makeSquare(8);
  for (const VertexId v : square.surface.vertices()) square.size[v] = 0.05 + 0.1 * square.surface.position(v).x;
  const IdMap<VertexId, double> sizes = spread(square);
  std::vector<Vec3> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const VertexId v : square.surface.vertices()) positions.push_back(square.surface.position(v) * 1024.0);
  for (const TriangleId t : square.surface.triangles()) {
    const auto corners = square.surface.corners(t);
    triangles.push_back({corners[0].value, corners[1].value, corners[2].value});
  }
  square.surface = Surface::build(std::move(positions), triangles).value();
  for (double& size : square.size.raw()) size *= 1024.0;
  const IdMap<VertexId, double> larger = spread(square);
  for (const VertexId v : square.surface.vertices()) EXPECT_EQ(larger[v], 1024.0 * sizes[v]);
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
