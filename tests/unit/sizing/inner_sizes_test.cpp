#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "qmcf/sizing/divide.hpp"
#include "qmcf/sizing/edge_curve.hpp"
#include "qmcf/sizing/size_field.hpp"
#include "qmcf/spatial/triangle_bvh.hpp"
#include "sizing/parts.hpp"

namespace qmcf {
namespace {

SizeField sizesOf(const TriangleMesh& mesh, const SizingOptions& options) {
  SilentProgress progress;
  Result<SizeField> field = computeSizeField(mesh, parts::brepOf(mesh), options, progress);
  EXPECT_TRUE(field.ok()) << field.error().message;
  return std::move(field).value();
}

SizingOptions withCurvature(double size, double chordError) {
  SizingOptions options;
  options.size = size;
  options.curvature = chordError;
  return options;
}

SizingOptions withSizes(std::vector<double> sizes) {
  SizingOptions options;
  options.vertexSize = std::move(sizes);
  return options;
}

/// The length of a chord of a circle whose middle is `error` from it.
double chord(double radius, double error) { return 2.0 * std::sqrt(2.0 * error * radius - error * error); }

void expectGraded(const SizeField& field) {
  for (const auto& t : field.inner.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto a = static_cast<std::size_t>(t[c]);
      const auto b = static_cast<std::size_t>(t[(c + 1) % 3]);
      const double rise = std::fabs(field.inner.value[a] - field.inner.value[b]);
      EXPECT_LE(rise, field.gradation * distance(field.inner.positions[a], field.inner.positions[b]) + 1e-12);
    }
  }
}

/// Two plates of the given width that meet at a right angle in a rounding of radius 1, drawn out to `length` as CAD
/// programs tessellate it: without vertices in between.
TriangleMesh roundedAngle(double width, double length, int segments) {
  std::vector<Vec3> profile{{-width, 1.0, 0.0}};
  for (int i = 0; i <= segments; ++i) {
    profile.push_back(parts::onCircle(1.0, 0.25 - 0.25 * i / segments));
  }
  profile.push_back({1.0, -width, 0.0});
  TriangleMesh mesh;
  for (const Vec3& p : profile) {
    mesh.positions.push_back(p);
    mesh.positions.push_back(p + Vec3{0.0, 0.0, length});
  }
  for (std::int32_t i = 0; i + 2 < static_cast<std::int32_t>(mesh.positions.size()); i += 2) {
    parts::addQuad(mesh, i, i + 1, i + 3, i + 2);
  }
  return mesh;
}

TEST(Curvature, OfASphereGivesTheChordOfItsGreatCircle) {
  const SizeField field = sizesOf(parts::sphere(24), withCurvature(1.0, 0.01));
  for (const double h : field.value) EXPECT_NEAR(h, chord(1.0, 0.01), 0.05 * chord(1.0, 0.01));
  EXPECT_EQ(field.sources.byCurvature, static_cast<std::int64_t>(field.value.size()));
  EXPECT_EQ(field.sources.floored, 0);
}

TEST(Curvature, OfACylinderDoesNotDependOnItsTessellation) {
  for (const int rows : {1, 12}) {
    const TriangleMesh mesh = parts::cylinderSide(64, rows, 2.0, 10.0);
    const SizeField field = sizesOf(mesh, withCurvature(3.0, 0.05));
    for (const double h : field.value) EXPECT_NEAR(h, chord(2.0, 0.05), 0.02 * chord(2.0, 0.05)) << rows;
    for (const EdgeSizes& edge : field.edges) {
      for (const double h : edge.value) EXPECT_NEAR(h, chord(2.0, 0.05), 0.02 * chord(2.0, 0.05)) << rows;
    }
  }
}

TEST(Curvature, LeavesFlatFacesAlone) {
  const SizeField field = sizesOf(parts::box(4.0, 4.0, 4.0), withCurvature(1.0, 1e-6));
  for (const double h : field.value) EXPECT_EQ(h, 1.0);
  EXPECT_EQ(field.sources.byCurvature, 0);
}

TEST(Curvature, MakesNothingSmallerThanATenthOfTheSize) {
  const SizeField field = sizesOf(parts::sphere(12), withCurvature(1.0, 1e-9));
  for (const double h : field.value) EXPECT_EQ(h, 0.1);
  EXPECT_EQ(field.sources.floored, static_cast<std::int64_t>(field.value.size()));
}

TEST(Curvature, OfARoundingFadesAcrossTheLargeTrianglesBesideIt) {
  const TriangleMesh mesh = roundedAngle(20.0, 30.0, 12);
  const SizeField field = sizesOf(mesh, withCurvature(2.0, 0.02));
  const double small = chord(1.0, 0.02);
  expectGraded(field);
  for (std::size_t v = 0; v < field.inner.positions.size(); ++v) {
    const Vec3& p = field.inner.positions[v];
    const bool isCurved = p.x > 1e-6 && p.y > 1e-6 && p.x < 1.0 - 1e-6;
    if (isCurved) {
      EXPECT_NEAR(field.inner.value[v], small, 0.1 * small);
    }
  }
  // The sizes grow by the gradation, not linearly over 20 from one end of a triangle to the other.
  const TriangleBvh tree(field.inner.positions, field.inner.triangles);
  for (const double x : {-2.0, -6.0, -10.0, -15.0}) {
    const ClosestPoint at = tree.closest({x, 1.0, 14.0});
    double h = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto t = static_cast<std::size_t>(at.triangle);
      h += at.barycentric[c] * field.inner.value[static_cast<std::size_t>(field.inner.triangles[t][c])];
    }
    EXPECT_LE(h, std::min(2.0, 1.35 * (small - field.gradation * x))) << x;
    EXPECT_GE(h, std::min(2.0, 0.8 * (small - field.gradation * x)) - 1e-12) << x;
  }
  for (const EdgeSizes& edge : field.edges) {
    if (std::fabs(edge.arcLength.back() - (40.0 + 0.5 * math::kPi)) > 0.1) continue;
    EXPECT_EQ(interpolate(edge.arcLength, edge.value, 8.0), 2.0);
    EXPECT_NEAR(interpolate(edge.arcLength, edge.value, 20.0 + 0.25 * math::kPi), small, 0.1 * small);
  }
}

TEST(Curvature, HoldsAlongEdgesOfTheBrep) {
  const TriangleMesh mesh = parts::disk(800, 1.0);
  const Brep brep = parts::brepOf(mesh);
  SilentProgress progress;
  const auto field = computeSizeField(mesh, brep, withCurvature(1.0, 0.004), progress);
  ASSERT_TRUE(field.ok());
  const DividedEdges divided = divideEdges(mesh, brep, field.value());
  const EdgeDivision& rim = divided.edges.at(0);
  EXPECT_GT(rim.nodes.size(), 30U);
  for (std::size_t i = 0; i + 1 < rim.nodes.size(); ++i) {
    const Vec3 middle = (divided.nodes[static_cast<std::size_t>(rim.nodes[i])] +
                         divided.nodes[static_cast<std::size_t>(rim.nodes[i + 1])]) *
                        0.5;
    EXPECT_LT(1.0 - norm(middle), 1.1 * 0.004);
  }
}

TEST(Curvature, IsCountedWhereANumberOfElementsIsAskedFor) {
  const TriangleMesh mesh = roundedAngle(10.0, 30.0, 24);
  SizingOptions options;
  options.quads = 2000;
  const double plain = sizesOf(mesh, options).base;
  for (const double chordError : {0.01, 0.006}) {
    options.curvature = chordError;
    const SizeField field = sizesOf(mesh, options);
    EXPECT_GT(field.base, 1.05 * plain);
    EXPECT_GT(field.sources.byCurvature, 0);
    EXPECT_NEAR(countOf(field.inner), 2000.0, 80.0) << chordError;
  }
}

TEST(VertexSizes, AreTheSizesWithoutAnElementSize) {
  const TriangleMesh mesh = parts::box(10.0, 10.0, 10.0);
  const SizeField field = sizesOf(mesh, withSizes(std::vector<double>(8, 0.5)));
  EXPECT_EQ(field.base, 0.5);
  for (const double h : field.value) EXPECT_EQ(h, 0.5);
}

TEST(VertexSizes, AreLinearInLargeTriangles) {
  const TriangleMesh mesh = parts::box(10.0, 10.0, 10.0);
  std::vector<double> sizes;
  for (const Vec3& p : mesh.positions) sizes.push_back(0.5 + 0.1 * p.x);
  const SizeField field = sizesOf(mesh, withSizes(sizes));
  EXPECT_EQ(field.base, 1.5);
  EXPECT_EQ(field.sources.bySizes, 4);
  const Brep brep = parts::brepOf(mesh);
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const EdgeCurve curve = edgeCurve(mesh, brep.edges[e]);
    for (std::size_t i = 0; i < field.edges[e].value.size(); ++i) {
      EXPECT_NEAR(field.edges[e].value[i], 0.5 + 0.1 * curve.at(field.edges[e].arcLength[i]).x, 1e-12);
    }
  }
  // Twice a face at each end and four of 10 times the integral of dx / (0.5 + 0.1 x)^2.
  EXPECT_NEAR(countOf(field.inner), 100.0 / 0.25 + 100.0 / 2.25 + 40.0 * 10.0 * (1.0 / 0.5 - 1.0 / 1.5), 1e-6);
}

TEST(VertexSizes, AreGradedAndBoundedByTheElementSize) {
  const TriangleMesh mesh = parts::sphere(24);
  std::vector<double> sizes(mesh.positions.size(), 5.0);
  sizes[0] = 0.01;
  SizingOptions options = withSizes(sizes);
  options.size = 0.3;
  const SizeField field = sizesOf(mesh, options);
  expectGraded(field);
  EXPECT_EQ(field.value[0], 0.01);
  EXPECT_EQ(*std::max_element(field.value.begin(), field.value.end()), 0.3);
  for (std::size_t v = 0; v < field.value.size(); ++v) {
    EXPECT_GE(field.value[v], std::min(0.3, 0.01 + 0.2 * distance(mesh.positions[v], mesh.positions[0])) - 1e-12);
  }
}

TEST(VertexSizes, ThatAreNoneAreRefused) {
  const TriangleMesh mesh = parts::box(1.0, 1.0, 1.0);
  std::vector<SizingOptions> bad(6, withSizes(std::vector<double>(8, 0.5)));
  bad[0].vertexSize.pop_back();
  bad[1].vertexSize[3] = 0.0;
  bad[2].vertexSize[3] = std::nan("");
  bad[3].quads = 100;
  bad[4].curvature = 0.0;
  bad[5].vertexSize.assign(8, 1e-6);
  for (const SizingOptions& options : bad) {
    SilentProgress progress;
    const Result<SizeField> field = computeSizeField(mesh, parts::brepOf(mesh), options, progress);
    ASSERT_FALSE(field.ok());
    EXPECT_EQ(field.error().code, ErrorCode::invalidOption);
  }
  // Too many elements in one place only.
  SizingOptions options = withSizes({1e-9, 1e-9, 1e-9, 1e-9, 1.0, 1.0, 1.0, 1.0});
  options.gradation = 1.0;
  SilentProgress progress;
  EXPECT_FALSE(computeSizeField(mesh, parts::brepOf(mesh), options, progress).ok());
}

TEST(CountInTriangle, IsTheIntegral) {
  for (const std::array<double, 3>& size :
       {std::array{1.0, 1.0, 1.0}, {1.0, 1.3, 1.1}, {1.0, 1.0, 4.0}, {0.1, 5.0, 5.0}, {0.1, 1.0, 3.0}}) {
    constexpr int kCells = 1500;
    double sum = 0.0;
    for (int i = 0; i < kCells; ++i) {
      for (int j = 0; i + j < kCells; ++j) {
        const auto at = [&](double u, double v) {
          const double h = size[0] + (size[1] - size[0]) * u / kCells + (size[2] - size[0]) * v / kCells;
          return 1.0 / (h * h);
        };
        sum += at(i + 1.0 / 3.0, j + 1.0 / 3.0);
        if (i + j + 1 < kCells) sum += at(i + 2.0 / 3.0, j + 2.0 / 3.0);
      }
    }
    const double expected = 3.0 * sum / kCells / kCells;
    EXPECT_NEAR(countInTriangle(size, 3.0), expected, 1e-3 * expected);
  }
}

TEST(InnerSizes, AreTheBaseTimesTheScale) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  parts::addQuad(mesh, 0, 1, 2, 3);
  const SizeScale scale(
      {{{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}, {{0, 1, 2}, {0, 2, 3}}, {0.8, 1.0, 1.0, 0.8}}});
  SizingOptions options;
  options.scale = &scale;
  options.quads = 400;
  const SizeField field = sizesOf(mesh, options);
  EXPECT_NEAR(countOf(field.inner), 400.0, 0.03 * 400.0);
  EXPECT_NEAR(field.nominal, 0.5, 0.02);
  EXPECT_NEAR(field.nominal, field.base * scale.mean(), 1e-12);
  for (std::size_t v = 0; v < field.inner.positions.size(); ++v) {
    EXPECT_NEAR(field.inner.value[v], field.base * (0.8 + 0.02 * field.inner.positions[v].x), 1e-9);
  }
  for (std::size_t e = 0; e < field.edges.size(); ++e) {
    for (const double size : field.edges[e].value) EXPECT_LE(size, field.base);
  }
}

}  // namespace
}  // namespace qmcf
