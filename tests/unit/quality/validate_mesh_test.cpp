#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "qmcf/quality/quality.hpp"
#include "quality/shapes.hpp"

namespace qmcf {
namespace {

using test::append;
using test::quadCube;
using test::quadSheet;

ValidityCheck checkNamed(const ValidityReport& report, std::string_view name) {
  const auto found = std::find_if(report.checks.begin(), report.checks.end(),
                                  [name](const ValidityCheck& check) { return check.name == name; });
  EXPECT_NE(found, report.checks.end()) << name;
  return found == report.checks.end() ? ValidityCheck{} : *found;
}

/// The mesh fails this check, with these ids, and no other one.
void expectOnly(const QuadMesh& mesh, std::string_view name, CheckStatus status,
                const std::vector<std::int64_t>& elements) {
  const ValidityReport report = validateMesh(mesh);
  EXPECT_EQ(report.valid, status != CheckStatus::fail);
  for (const ValidityCheck& check : report.checks) {
    EXPECT_EQ(check.status, check.name == name ? status : CheckStatus::pass) << check.name;
    EXPECT_EQ(check.count == 0, check.status == CheckStatus::pass) << check.name;
    EXPECT_EQ(check.sentence.empty(), check.status == CheckStatus::pass) << check.name;
  }
  EXPECT_EQ(checkNamed(report, name).elements, elements);
}

TEST(ValidateMesh, PassesClosedAndOpenMeshes) {
  EXPECT_TRUE(validateMesh(quadCube(3)).valid);
  EXPECT_TRUE(validateMesh(quadSheet(4, 2, {}, {4, 0, 0}, {0, 2, 0})).valid);
}

TEST(ValidateMesh, FindsNothingToMeasure) { expectOnly({}, "empty", CheckStatus::fail, {}); }

TEST(ValidateMesh, FindsIndicesOutsideTheMesh) {
  QuadMesh mesh = quadSheet(2, 1, {}, {2, 0, 0}, {0, 1, 0});
  mesh.elements.push_back({0, 1, 6, kNone});
  mesh.elements.push_back({0, -5, 1, kNone});
  expectOnly(mesh, "indexOutOfRange", CheckStatus::fail, {2, 3});
}

TEST(ValidateMesh, FindsNumbersThatAreNotFinite) {
  QuadMesh mesh = quadSheet(1, 1, {}, {1, 0, 0}, {0, 1, 0});
  mesh.positions.push_back({2, std::numeric_limits<double>::quiet_NaN(), 0});
  mesh.elements.push_back({1, 4, 3, kNone});
  expectOnly(mesh, "nonFiniteCoordinate", CheckStatus::fail, {4});
}

TEST(ValidateMesh, FindsRepeatedCorners) {
  QuadMesh mesh = quadSheet(2, 1, {}, {2, 0, 0}, {0, 1, 0});
  mesh.elements.push_back({0, 1, 1, 3});
  expectOnly(mesh, "repeatedCorner", CheckStatus::fail, {2});
}

TEST(ValidateMesh, FindsDuplicatesHoweverTheyTurn) {
  QuadMesh mesh = quadSheet(1, 1, {}, {1, 0, 0}, {0, 1, 0});
  mesh.elements.push_back({2, 3, 1, 0});  // The square has 0, 1, 3, 2; this one goes round the other way.
  expectOnly(mesh, "duplicateElements", CheckStatus::fail, {1});
}

TEST(ValidateMesh, WarnsAboutVerticesWithoutElements) {
  QuadMesh mesh = quadSheet(1, 1, {}, {1, 0, 0}, {0, 1, 0});
  mesh.positions.push_back({9, 9, 9});
  expectOnly(mesh, "unreferencedVertices", CheckStatus::warn, {4});
}

TEST(ValidateMesh, FindsFoldedAndFlatElements) {
  QuadMesh folded = quadSheet(3, 3, {}, {3, 0, 0}, {0, 3, 0});
  // The middle square's first corner is pushed over its opposite one; the corner square behind it only grows.
  folded.positions[5] = {2.3, 2.3, 0};
  const ValidityReport report = validateMesh(folded);
  EXPECT_FALSE(report.valid);
  const auto inverted = checkNamed(report, "invertedElements").elements;
  EXPECT_TRUE(std::find(inverted.begin(), inverted.end(), 4) != inverted.end());
  EXPECT_TRUE(std::find(inverted.begin(), inverted.end(), 0) == inverted.end());

  QuadMesh flat = quadSheet(1, 1, {}, {1, 0, 0}, {0, 1, 0});
  flat.positions.push_back({3, 0, 0});
  flat.elements.push_back({1, 0, 4, kNone});
  expectOnly(flat, "invertedElements", CheckStatus::fail, {1});
}

TEST(ValidateMesh, FindsElementsThatFaceTheOtherWay) {
  QuadMesh mesh = quadSheet(3, 1, {}, {3, 0, 0}, {0, 1, 0});
  std::reverse(mesh.elements[1].begin(), mesh.elements[1].end());
  expectOnly(mesh, "orientationConflicts", CheckStatus::fail, {0, 1});
}

TEST(ValidateMesh, AllowsAChangeOfSidesOnlyAtFeatures) {
  QuadMesh mesh = quadSheet(2, 1, {}, {2, 0, 0}, {0, 1, 0});
  std::reverse(mesh.elements[1].begin(), mesh.elements[1].end());
  mesh.featureSegments.push_back({4, 1, 0});
  expectOnly(mesh, "orientationConflicts", CheckStatus::warn, {0});
}

TEST(ValidateMesh, AllowsMoreThanTwoElementsOnlyAtFeatures) {
  QuadMesh mesh = quadSheet(2, 1, {}, {2, 0, 0}, {0, 1, 0});
  append(mesh, quadSheet(1, 1, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), true);
  expectOnly(mesh, "nonManifoldEdges", CheckStatus::fail, {0});
  mesh.featureSegments.push_back({1, 4, 0});
  expectOnly(mesh, "nonManifoldEdges", CheckStatus::pass, {});
}

TEST(ValidateMesh, WarnsAboutPinchedVertices) {
  QuadMesh mesh = quadSheet(1, 1, {}, {1, 0, 0}, {0, 1, 0});
  append(mesh, quadSheet(1, 1, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}), true);
  expectOnly(mesh, "nonManifoldVertices", CheckStatus::warn, {3});
}

TEST(ValidateMesh, FindsFeatureSegmentsThatAreNoEdges) {
  QuadMesh mesh = quadSheet(2, 1, {}, {2, 0, 0}, {0, 1, 0});
  mesh.featureSegments = {{0, 1, 0}, {2, 1, 0}, {0, 4, 0}, {7, 99, 0}};
  expectOnly(mesh, "featureSegments", CheckStatus::fail, {0, 7});
}

TEST(ValidateMesh, ListsAllIds) {
  QuadMesh mesh = quadSheet(1, 1, {}, {1, 0, 0}, {0, 1, 0});
  for (int i = 0; i < 250; ++i) mesh.elements.push_back({0, 0, 1, kNone});
  const ValidityReport report = validateMesh(mesh);
  EXPECT_EQ(checkNamed(report, "repeatedCorner").count, 250);
  EXPECT_EQ(checkNamed(report, "repeatedCorner").elements.size(), 250U);
}

}  // namespace
}  // namespace qmcf
