#include "qmcf/sizing/slits.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "qmcf/sizing/divide.hpp"
#include "sizing/parts.hpp"

namespace qmcf {
namespace {

std::vector<EdgeCurve> curvesOf(const TriangleMesh& mesh, const Brep& brep) {
  std::vector<EdgeCurve> curves;
  for (const BrepEdge& edge : brep.edges) curves.push_back(edgeCurve(mesh, edge));
  return curves;
}

/// The slits that are no wider than slitWidth() in the middle of their first edge.
std::vector<std::array<std::int32_t, 2>> closeSlits(const TriangleMesh& mesh, const Brep& brep) {
  const std::vector<EdgeCurve> curves = curvesOf(mesh, brep);
  const double width = slitWidth(mesh);
  auto slits = findSlits(brep, curves, width);
  std::erase_if(slits, [&](const auto& slit) {
    const EdgeCurve& one = curves[static_cast<std::size_t>(slit[0])];
    return !acrossSlit(curves[static_cast<std::size_t>(slit[1])], one.at(0.5 * one.length()), width);
  });
  return slits;
}

TEST(Slits, AreTheSidesOfACrack) {
  for (const double open : {1e-7, 1e-5}) {
    const TriangleMesh mesh = parts::crackedSquare(open);
    const Brep brep = parts::brepOf(mesh);
    const auto slits = closeSlits(mesh, brep);
    ASSERT_EQ(slits.size(), 1U) << open;
    const double both = brep.edges[static_cast<std::size_t>(slits[0][0])].length +
                        brep.edges[static_cast<std::size_t>(slits[0][1])].length;
    EXPECT_NEAR(both, 1.94, 1e-6) << open;
  }
  for (const double open : {1e-2, 0.2}) {
    const TriangleMesh mesh = parts::crackedSquare(open);
    EXPECT_TRUE(closeSlits(mesh, parts::brepOf(mesh)).empty()) << open;
  }
}

TEST(Slits, NeedNoCommonVertex) {
  // Two strips beside each other; the second begins and ends elsewhere.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0},    {2, 0, 0},    {2, 1, 0},       {0, 1, 0},
                    {0.3, -1, 0}, {1.4, -1, 0}, {1.4, -1e-6, 0}, {0.3, -1e-6, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  EXPECT_NEAR(slitWidth(mesh), 1e-5 * std::sqrt(8.0), 1e-12);
  EXPECT_EQ(closeSlits(mesh, parts::brepOf(mesh)).size(), 1U);
}

TEST(Slits, ArcLengthAcrossIsThatOfTheNearestPlace) {
  EdgeCurve curve;
  curve.points = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}};
  curve.arcLength = {0.0, 1.0, 3.0};
  const auto on = acrossSlit(curve, {1.01, 0.5, 0.0}, 0.02);
  ASSERT_TRUE(on.has_value());
  EXPECT_NEAR(*on, 1.5, 1e-12);
  EXPECT_FALSE(acrossSlit(curve, {1.03, 0.5, 0.0}, 0.02).has_value());  // Too far,
  EXPECT_FALSE(acrossSlit(curve, {0.01, 0.0, 0.0}, 0.02).has_value());  // and too near to an end.
}

TEST(Slits, HaveNodesAcrossFromEachOther) {
  const TriangleMesh mesh = parts::crackedSquare(4e-6);
  const Brep brep = parts::brepOf(mesh);
  SizingOptions options;
  options.size = 0.13;
  SilentProgress silent;
  const auto field = computeSizeField(mesh, brep, options, silent);
  ASSERT_TRUE(field.ok());
  const DividedEdges divided = divideEdges(mesh, brep, field.value());
  const auto slits = closeSlits(mesh, brep);
  ASSERT_EQ(slits.size(), 1U);
  const auto& one = divided.edges[static_cast<std::size_t>(slits[0][0])];
  const auto& other = divided.edges[static_cast<std::size_t>(slits[0][1])];
  ASSERT_GT(one.nodes.size(), 6U);
  std::size_t across = 0;
  for (std::size_t i = 1; i + 1 < one.nodes.size(); ++i) {
    for (std::size_t j = 1; j + 1 < other.nodes.size(); ++j) {
      const Vec3& p = divided.nodes[static_cast<std::size_t>(one.nodes[i])];
      if (distance(p, divided.nodes[static_cast<std::size_t>(other.nodes[j])]) < 5e-6) ++across;
    }
  }
  // All but the last, which is beside the shorter side's end.
  EXPECT_GE(across + 1, one.nodes.size() - 2);
}

}  // namespace
}  // namespace qmcf
