#include "qmcf/sizing/size_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "qmcf/sizing/edge_curve.hpp"
#include "sizing/parts.hpp"

namespace qmcf {
namespace {

SizeField sizesOf(const TriangleMesh& mesh, const Brep& brep, const SizingOptions& options) {
  SilentProgress progress;
  Result<SizeField> field = computeSizeField(mesh, brep, options, progress);
  EXPECT_TRUE(field.ok()) << field.error().message;
  return std::move(field).value();
}

SizingOptions ofSize(double size) {
  SizingOptions options;
  options.size = size;
  return options;
}

double smallest(const SizeField& field) {
  double least = field.base;
  for (const EdgeSizes& edge : field.edges)
    least = std::min(least, *std::min_element(edge.value.begin(), edge.value.end()));
  return least;
}

TEST(SizeField, TakesTheSizeOrDerivesItFromTheCount) {
  const TriangleMesh mesh = parts::box(1.0, 2.0, 3.0);
  const Brep brep = parts::brepOf(mesh);
  EXPECT_DOUBLE_EQ(sizesOf(mesh, brep, ofSize(0.25)).base, 0.25);
  SizingOptions count;
  count.quads = 88;
  EXPECT_NEAR(sizesOf(mesh, brep, count).base, std::sqrt(22.0 / 88.0), 1e-12);
}

TEST(SizeField, RefusesOptionsOutOfRange) {
  const TriangleMesh mesh = parts::box(1.0, 1.0, 1.0);
  const Brep brep = parts::brepOf(mesh);
  SilentProgress progress;
  std::vector<SizingOptions> bad(8);
  bad[0].size = 0.0;
  bad[1].size = -1.0;
  bad[2].size = HUGE_VAL;
  bad[3].quads = 0;
  bad[4].size = 1.0;
  bad[4].quads = 10;
  bad[5].gradation = 0.0;
  bad[6].divisionsPerTurn = 2;
  bad[7].size = 1e-6;
  for (const SizingOptions& options : bad) {
    const Result<SizeField> field = computeSizeField(mesh, brep, options, progress);
    ASSERT_FALSE(field.ok());
    EXPECT_EQ(field.error().code, ErrorCode::invalidOption);
  }
}

TEST(SizeField, StopsWhenAsked) {
  class Stop final : public Progress {
    bool report(Stage, double) override { return false; }
  } stop;
  const TriangleMesh mesh = parts::box(1.0, 1.0, 1.0);
  const Result<SizeField> field = computeSizeField(mesh, parts::brepOf(mesh), {}, stop);
  ASSERT_FALSE(field.ok());
  EXPECT_EQ(field.error().code, ErrorCode::cancelled);
}

TEST(SizeField, CircleTurnsAnEighthWithinOneSizeWhateverItsTessellation) {
  for (const int segments : {16, 64, 500}) {
    const TriangleMesh mesh = parts::disk(segments, 1.0);
    const SizeField field = sizesOf(mesh, parts::brepOf(mesh), ofSize(2.0));
    const double arc = 2.0 * math::kPi / 8.0;
    EXPECT_NEAR(smallest(field), arc, 0.08 * arc) << segments;
    EXPECT_EQ(field.minimumDivisions[0], 8);
  }
}

TEST(SizeField, StraightEdgesDoNotRefine) {
  const TriangleMesh mesh = parts::box(4.0, 4.0, 4.0);
  const SizeField field = sizesOf(mesh, parts::brepOf(mesh), ofSize(1.0));
  EXPECT_DOUBLE_EQ(smallest(field), 1.0);
}

TEST(SizeField, NarrowPlacesDoNotRefine) {
  // The hole is large enough not to refine by its curvature; its rim comes within 0.2 of the plate's edge at x = 10.
  const TriangleMesh plate = parts::plateWithHole(10.0, {5.8, 0.0, 0.0}, 4.0, 64);
  EXPECT_DOUBLE_EQ(smallest(sizesOf(plate, parts::brepOf(plate), ofSize(1.0))), 1.0);
}

TEST(SizeField, CountsRowsHoweverNarrow) {
  // A strip of 100 by 0.01 takes a row of elements, not a hundredth of one for each unit of length.
  const TriangleMesh strip = parts::sheet({0, 100}, {0, 0.01}, [](int, int) { return true; });
  SizingOptions options;
  options.quads = 400;
  const SizeField field = sizesOf(strip, parts::brepOf(strip), options);
  // As large as the search goes: fewer elements are not to be had.
  EXPECT_NEAR(field.base, 1.7 * std::sqrt(1.0 / 400.0), 1e-9);
  // Beside a plate of 100 elements they are a part of those asked for.
  const TriangleMesh both =
      parts::sheet({0, 100, 110}, {0, 0.01, 10}, [](int i, int j) { return (i == 0) == (j == 0); });
  options.quads = 200;
  EXPECT_NEAR(sizesOf(both, parts::brepOf(both), options).base, 1.0, 0.1);
}

TEST(SizeField, IsTheSameOnBothSidesOfAStripOneElementWide) {
  // A narrow tower makes for small elements on the upper side of the strip below it.
  const auto isThere = [](int i, int j) { return j == 0 || i == 1; };
  const TriangleMesh mesh = parts::sheet({0, 10, 10.4, 20}, {0, 0.7, 4}, isThere);
  const Brep brep = parts::brepOf(mesh);
  const SizeField field = sizesOf(mesh, brep, ofSize(1.0));
  const auto sizeAt = [&](double x, double y) {
    for (std::size_t e = 0; e < brep.edges.size(); ++e) {
      const EdgeCurve curve = edgeCurve(mesh, brep.edges[e]);
      for (double s = 0.0; s < curve.length(); s += 0.01) {
        if (distance(curve.at(s), {x, y, 0.0}) < 0.006)
          return interpolate(field.edges[e].arcLength, field.edges[e].value, s);
      }
    }
    return 0.0;
  };
  for (const double x : {9.0, 9.5, 11.0}) {
    const double below = sizeAt(x, 0.0);
    EXPECT_GT(below, 0.2);
    EXPECT_NEAR(below / sizeAt(x, 0.7), 1.0, 0.03) << x;
  }
}

TEST(SizeField, SlopeIsBoundedAlongAndAcrossTheFace) {
  const TriangleMesh mesh = parts::plateWithHole(10.0, {3.0, 2.0, 0.0}, 0.5, 32);
  const Brep brep = parts::brepOf(mesh);
  const SizeField field = sizesOf(mesh, brep, ofSize(2.0));
  struct Sample {
    Vec3 position;
    double size;
  };
  std::vector<Sample> samples;
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const EdgeCurve curve = edgeCurve(mesh, brep.edges[e]);
    for (std::size_t i = 0; i < field.edges[e].value.size(); ++i) {
      samples.push_back({curve.at(field.edges[e].arcLength[i]), field.edges[e].value[i]});
    }
  }
  double largest = 0.0;
  for (const Sample& a : samples) {
    largest = std::max(largest, a.size);
    for (const Sample& b : samples) {
      EXPECT_LE(a.size, b.size + field.gradation * distance(a.position, b.position) + 1e-9);
    }
  }
  // The small hole must not refine the whole of the coarse plate.
  EXPECT_DOUBLE_EQ(largest, 2.0);
}

TEST(SizeField, VertexValuesAgreeWithTheEdges) {
  const TriangleMesh mesh = parts::plateWithHole(5.0, {}, 0.5, 32);
  const Brep brep = parts::brepOf(mesh);
  const SizeField field = sizesOf(mesh, brep, ofSize(1.0));
  ASSERT_EQ(field.value.size(), mesh.positions.size());
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const EdgeCurve curve = edgeCurve(mesh, brep.edges[e]);
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const double onEdge = interpolate(field.edges[e].arcLength, field.edges[e].value, curve.arcLength[i]);
      EXPECT_NEAR(field.value[static_cast<std::size_t>(brep.edges[e].points[i])], onEdge, 1e-12);
    }
  }
}

TEST(EdgeCurve, RunsByArcLength) {
  const TriangleMesh mesh = parts::disk(4, 1.0);
  BrepEdge edge;
  edge.points = {0, 1, 2};
  edge.start = 0;
  edge.end = 1;
  const EdgeCurve curve = edgeCurve(mesh, edge);
  EXPECT_NEAR(curve.length(), 2.0 * std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(distance(curve.at(0.5 * std::sqrt(2.0)), {0.5, 0.5, 0.0}), 0.0, 1e-14);
  EXPECT_NEAR(distance(curve.at(-1.0), {1.0, 0.0, 0.0}), 0.0, 1e-14);
  EXPECT_NEAR(distance(curve.at(99.0), {-1.0, 0.0, 0.0}), 0.0, 1e-14);
}

}  // namespace
}  // namespace qmcf
