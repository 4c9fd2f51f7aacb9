#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "qmcf/quality/quality.hpp"
#include "quality/shapes.hpp"

namespace qmcf {
namespace {

using test::append;
using test::quadCube;
using test::quadSheet;
using test::triangulated;

ValidityCheck checkNamed(const QualityReport& report, std::string_view name) {
  const auto found = std::find_if(report.checks.begin(), report.checks.end(),
                                  [name](const ValidityCheck& check) { return check.name == name; });
  EXPECT_NE(found, report.checks.end()) << name;
  return found == report.checks.end() ? ValidityCheck{} : *found;
}

CheckStatus statusOf(const QualityReport& report, std::string_view name) { return checkNamed(report, name).status; }

void expectFailures(const QualityReport& report, std::vector<std::string_view> names) {
  for (const ValidityCheck& check : report.checks) {
    const bool expected = std::find(names.begin(), names.end(), check.name) != names.end();
    EXPECT_EQ(check.status == CheckStatus::fail, expected) << check.name << ": " << check.sentence;
  }
  EXPECT_EQ(report.valid, names.empty());
}

TEST(MeasureQuality, CountsAndFiguresOfACube) {
  const int n = 4;
  const QuadMesh mesh = quadCube(n);
  const QualityReport report = measureQuality(mesh, nullptr, {});
  EXPECT_EQ(report.quads, 6 * n * n);
  EXPECT_EQ(report.triangles, 0);
  EXPECT_EQ(report.vertices, 6 * n * n + 2);
  EXPECT_EQ(report.eulerCharacteristic, 2);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.boundaryEdges, 0);
  EXPECT_EQ(report.interiorVertices, report.vertices);
  EXPECT_EQ(report.irregularVertices, 8);
  EXPECT_DOUBLE_EQ(*report.regularShare, 1.0 - 8.0 / (6 * n * n + 2));
  EXPECT_DOUBLE_EQ(report.quadShare, 1.0);
  EXPECT_DOUBLE_EQ(report.area, 6.0 * n * n);
  EXPECT_DOUBLE_EQ(report.size, 1.0);
  EXPECT_NEAR(report.sizeError, 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(report.scaledJacobian.worst, 1.0);
  EXPECT_FALSE(report.largestDistance.has_value());
  EXPECT_FALSE(report.sharpRecall.has_value());
  expectFailures(report, {});
}

TEST(MeasureQuality, ARowHasNoShareOfRegularVerticesAndNoTriangles) {
  const QualityReport report = measureQuality(quadSheet(5, 1, {}, {1, 0, 0}, {0, 1, 0}), nullptr, {});
  EXPECT_EQ(report.interiorVertices, 0);
  EXPECT_FALSE(report.regularShare.has_value());
  EXPECT_TRUE(std::isnan(report.triangleScaledJacobian.worst));
}

TEST(MeasureQuality, SizeErrorIsInPowersOfTwo) {
  QualityOptions options;
  options.size = 4.0;
  EXPECT_NEAR(measureQuality(quadCube(2), nullptr, options).sizeError, 2.0, 1e-14);
}

TEST(MeasureQuality, DistributionsHaveTheirWorstAtTheRightEnd) {
  // 200 rectangles 1 x 1, 1 x 2 ... 1 x 200 in a row.
  QuadMesh mesh;
  double x = 0.0;
  for (int i = 1; i <= 200; ++i) {
    append(mesh, quadSheet(1, 1, {x, 0, 0}, {double(i), 0, 0}, {0, 1, 0}), true);
    x += i;
  }
  const QualityReport report = measureQuality(mesh, nullptr, {});
  EXPECT_NEAR(report.aspectRatio.mean, 100.5, 1e-9);
  EXPECT_NEAR(report.aspectRatio.worst, 200.0, 1e-9);
  EXPECT_NEAR(report.aspectRatio.median, 100.5, 1e-9);
  EXPECT_NEAR(report.aspectRatio.p1, 200.0 - 1.99, 1e-9);
  EXPECT_DOUBLE_EQ(report.scaledJacobian.p1, 1.0);
}

TEST(MeasureQuality, LeavesInfiniteRatiosOutAndSaysSo) {
  QuadMesh mesh = quadSheet(2, 1, {}, {2, 0, 0}, {0, 1, 0});
  mesh.positions[5] = {1.2, 0.2, 0};  // The second square becomes concave.
  const QualityReport report = measureQuality(mesh, nullptr, {});
  EXPECT_EQ(report.jacobianRatio.infinite, 1);
  EXPECT_NEAR(report.jacobianRatio.mean, 1.0, 1e-12);
  EXPECT_LT(report.scaledJacobian.worst, 0.0);
  expectFailures(report, {"invertedElements"});
}

TEST(MeasureQuality, TrianglesMakeTheirVerticesIrregular) {
  QuadMesh mesh = quadSheet(4, 4, {}, {4, 0, 0}, {0, 4, 0});
  const Element e = mesh.elements[5];
  mesh.elements[5] = {e[0], e[1], e[2], kNone};
  mesh.elements.push_back({e[0], e[2], e[3], kNone});
  const QualityReport report = measureQuality(mesh, nullptr, {});
  EXPECT_EQ(report.triangles, 2);
  EXPECT_EQ(report.interiorVertices, 9);
  EXPECT_EQ(report.irregularVertices, 4);
  EXPECT_NEAR(report.triangleScaledJacobian.mean, std::sqrt(2.0 / 3.0), 1e-12);
}

TEST(MeasureQuality, CubeKeepsAllOfItself) {
  const TriangleMesh part = triangulated(quadCube(1));
  const QualityReport report = measureQuality(quadCube(5), nullptr, {});
  EXPECT_FALSE(report.cornerRecall.has_value());
  QuadMesh mesh = quadCube(5);
  for (Vec3& p : mesh.positions) p = p / 5.0;
  const QualityReport against = measureQuality(mesh, &part, {});
  expectFailures(against, {});
  EXPECT_NEAR(*against.largestDistance, 0.0, 1e-15);
  EXPECT_NEAR(*against.meanDistance, 0.0, 1e-15);
  EXPECT_NEAR(*against.largestGap, 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(*against.sharpRecall, 1.0);
  EXPECT_DOUBLE_EQ(*against.cornerRecall, 1.0);
  EXPECT_FALSE(against.boundaryRecall.has_value());
  EXPECT_FALSE(against.nonManifoldRecall.has_value());
}

TEST(MeasureQuality, UnweldedReferenceIsTheSamePart) {
  const TriangleMesh shared = triangulated(quadCube(3));
  TriangleMesh soup;
  for (const auto& triangle : shared.triangles) {
    const auto first = static_cast<std::int32_t>(soup.positions.size());
    for (const std::int32_t v : triangle) soup.positions.push_back(shared.positions[static_cast<std::size_t>(v)]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  soup.positions[0].x = -0.0;
  const QualityReport report = measureQuality(quadCube(3), &soup, {});
  expectFailures(report, {});
  EXPECT_DOUBLE_EQ(*report.sharpRecall, 1.0);
}

TEST(MeasureQuality, HoleInAClosedPartIsFound) {
  const TriangleMesh part = triangulated(quadCube(3));
  QuadMesh mesh = quadCube(3);
  mesh.elements.pop_back();
  const QualityReport report = measureQuality(mesh, &part, {});
  expectFailures(report, {"boundary", "euler", "indexLedger"});
  EXPECT_EQ(checkNamed(report, "boundary").count, 4);
  EXPECT_EQ(report.boundaryEdges, 4);
  // The gap is measured at the missing square's triangles: their centres are 1/3 from its sides.
  EXPECT_NEAR(*report.largestGap, 1.0 / 3.0, 1e-12);
}

TEST(MeasureQuality, RoundedEdgesAreNotRecalled) {
  const TriangleMesh part = triangulated(quadCube(4));
  QuadMesh mesh = quadCube(4);
  // All vertices of the four edges along z move inwards by 0.2 of the size.
  for (Vec3& p : mesh.positions) {
    const bool alongZ = (p.x == 0.0 || p.x == 4.0) && (p.y == 0.0 || p.y == 4.0);
    if (!alongZ) continue;
    p.x += p.x == 0.0 ? 0.2 : -0.2;
    p.y += p.y == 0.0 ? 0.2 : -0.2;
  }
  QualityOptions options;
  options.size = 1.0;
  const QualityReport report = measureQuality(mesh, &part, options);
  EXPECT_EQ(*report.cornerRecall, 0.0);
  EXPECT_LT(*report.sharpRecall, 2.0 / 3.0);
  EXPECT_GT(*report.sharpRecall, 1.0 / 3.0);
  EXPECT_NEAR(*report.largestDistance, 0.2, 1e-12);
}

TEST(MeasureQuality, FeatureAngleDecidesWhatIsSharp) {
  const TriangleMesh part = triangulated(quadCube(2));
  QualityOptions options;
  options.featureAngle = 95.0;
  EXPECT_FALSE(measureQuality(quadCube(2), &part, options).sharpRecall.has_value());
  options.featureAngle = 85.0;
  EXPECT_DOUBLE_EQ(*measureQuality(quadCube(2), &part, options).sharpRecall, 1.0);
}

TEST(MeasureQuality, InsideOutMeshIsTurnedOver) {
  const TriangleMesh part = triangulated(quadCube(3));
  QuadMesh mesh = quadCube(3);
  for (Element& element : mesh.elements) std::reverse(element.begin(), element.end());
  const QualityReport report = measureQuality(mesh, &part, {});
  expectFailures(report, {"facesTurnedOver"});
  EXPECT_EQ(checkNamed(report, "facesTurnedOver").count, report.quads);
}

TEST(MeasureQuality, DistanceOfAParallelSheet) {
  const TriangleMesh part = triangulated(quadSheet(3, 3, {}, {3, 0, 0}, {0, 3, 0}));
  const QualityReport report = measureQuality(quadSheet(5, 5, {0, 0, 0.25}, {3, 0, 0}, {0, 3, 0}), &part, {});
  EXPECT_NEAR(*report.meanDistance, 0.25, 1e-12);
  EXPECT_NEAR(*report.largestDistance, 0.25, 1e-12);
  EXPECT_NEAR(*report.largestGap, 0.25, 1e-12);
  EXPECT_EQ(*report.boundaryRecall, 0.0);
}

TEST(MeasureQuality, OpenPartMustKeepItsBoundary) {
  const TriangleMesh part = triangulated(quadSheet(6, 6, {}, {6, 0, 0}, {0, 6, 0}));
  const QualityReport whole = measureQuality(quadSheet(8, 8, {}, {6, 0, 0}, {0, 6, 0}), &part, {});
  expectFailures(whole, {});
  EXPECT_DOUBLE_EQ(*whole.boundaryRecall, 1.0);
  EXPECT_DOUBLE_EQ(*whole.cornerRecall, 1.0);
  const QualityReport half = measureQuality(quadSheet(4, 8, {}, {3, 0, 0}, {0, 6, 0}), &part, {});
  expectFailures(half, {"boundary", "coverage"});
  EXPECT_DOUBLE_EQ(*half.cornerRecall, 0.5);
  EXPECT_NEAR(*half.boundaryRecall, 0.5, 1e-12);
}

TEST(MeasureQuality, CracksAndTJunctionsAreFound) {
  const TriangleMesh part = triangulated(quadSheet(8, 4, {}, {8, 0, 0}, {0, 4, 0}));
  QuadMesh cracked = quadSheet(4, 4, {}, {4, 0, 0}, {0, 4, 0});
  append(cracked, quadSheet(4, 4, {4, 0, 0}, {4, 0, 0}, {0, 4, 0}), false);
  const QualityReport crack = measureQuality(cracked, &part, {});
  EXPECT_EQ(checkNamed(crack, "cracks").count, 10);
  EXPECT_EQ(statusOf(crack, "tJunctions"), CheckStatus::pass);
  EXPECT_EQ(statusOf(crack, "components"), CheckStatus::fail);

  QuadMesh hanging = quadSheet(4, 4, {}, {4, 0, 0}, {0, 4, 0});
  append(hanging, quadSheet(4, 8, {4, 0, 0}, {4, 0, 0}, {0, 4, 0}), true);
  const QualityReport junction = measureQuality(hanging, &part, {});
  EXPECT_EQ(statusOf(junction, "cracks"), CheckStatus::pass);
  EXPECT_EQ(checkNamed(junction, "tJunctions").count, 4);
  EXPECT_EQ(statusOf(junction, "boundary"), CheckStatus::fail);
}

TEST(MeasureQuality, NonManifoldPartMayHaveNonManifoldMesh) {
  const auto sheets = [](int n, int others) {
    QuadMesh mesh = quadSheet(n, n, {}, {4, 0, 0}, {0, 4, 0});
    append(mesh, quadSheet(n, n, {4, 0, 0}, {4, 0, 0}, {0, 4, 0}), true);
    append(mesh, quadSheet(n, others, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}), true);
    return mesh;
  };
  const TriangleMesh part = triangulated(sheets(2, 2));
  const QualityReport report = measureQuality(sheets(4, 4), &part, {});
  expectFailures(report, {});
  EXPECT_DOUBLE_EQ(*report.nonManifoldRecall, 1.0);
  EXPECT_DOUBLE_EQ(*report.boundaryRecall, 1.0);

  const TriangleMesh flat = triangulated(quadSheet(8, 4, {}, {8, 0, 0}, {0, 4, 0}));
  EXPECT_EQ(checkNamed(measureQuality(sheets(4, 4), &flat, {}), "nonManifoldEdges").count, 4);
}

TEST(MeasureQuality, TwoPartsMustStayTwo) {
  QuadMesh both = quadCube(2);
  QuadMesh other = quadCube(2);
  for (Vec3& p : other.positions) p.x += 5.0;
  append(both, other, true);
  const TriangleMesh part = triangulated(both);
  expectFailures(measureQuality(both, &part, {}), {});
  const QualityReport one = measureQuality(quadCube(2), &part, {});
  expectFailures(one, {"components", "euler", "indexLedger", "coverage"});
  EXPECT_NEAR(*one.largestGap, 5.0, 1e-12);
}

TEST(MeasureQuality, NothingAndNonsenseAreMeasuredToo) {
  const TriangleMesh part = triangulated(quadCube(1));
  EXPECT_FALSE(measureQuality({}, &part, {}).valid);
  const TriangleMesh nothing;
  EXPECT_FALSE(measureQuality({}, &nothing, {}).valid);
  TriangleMesh needle;
  needle.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  needle.triangles = {{0, 1, 2}, {0, 1, 7}};
  EXPECT_FALSE(measureQuality(quadCube(1), &needle, {}).valid);
}

}  // namespace
}  // namespace qmcf
