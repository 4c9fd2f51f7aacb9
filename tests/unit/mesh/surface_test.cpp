#include "qmcf/mesh/surface.hpp"

#include <gtest/gtest.h>

#include <set>

#include "qmcf/base/math.hpp"

namespace qmcf {
namespace {

using Triangles = std::vector<std::array<std::int32_t, 3>>;

const std::vector<Vec3> kTetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const Triangles kTetrahedronSides{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

/// A flat ring of n quadrilaterals, each cut in two.
Surface ring(int n) {
  std::vector<Vec3> positions;
  Triangles triangles;
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * math::kPi * i / n;
    positions.push_back({math::cos(a), math::sin(a), 0.0});
    positions.push_back({2.0 * math::cos(a), 2.0 * math::sin(a), 0.0});
    const int next = (i + 1) % n;
    triangles.push_back({2 * i, 2 * i + 1, 2 * next + 1});
    triangles.push_back({2 * i, 2 * next + 1, 2 * next});
  }
  return Surface::build(positions, triangles).value();
}

TEST(Surface, TetrahedronIsClosed) {
  const Surface s = Surface::build(kTetrahedron, kTetrahedronSides).value();
  EXPECT_EQ(s.eulerCharacteristic(), 2);
  EXPECT_TRUE(s.boundaryLoops().empty());
  for (const HalfedgeId h : s.halfedges()) {
    ASSERT_TRUE(s.twin(h).valid());
    EXPECT_EQ(s.twin(s.twin(h)), h);
    EXPECT_EQ(s.origin(s.twin(h)), s.target(h));
    EXPECT_EQ(Surface::next(Surface::next(Surface::next(h))), h);
    EXPECT_EQ(Surface::prev(Surface::next(h)), h);
  }
  Vec3 sum;
  for (const TriangleId t : s.triangles()) sum += s.areaVector(t);
  EXPECT_NEAR(norm(sum), 0.0, 1e-15);
}

TEST(Surface, FanVisitsEachTriangleOfAVertexOnceAndCounterClockwise) {
  const Surface s = ring(12);
  std::size_t visited = 0;
  for (const VertexId v : s.vertices()) {
    EXPECT_TRUE(s.isBoundary(v));
    std::set<std::int32_t> triangles;
    HalfedgeId last;
    s.forEachOutgoing(v, [&](HalfedgeId h) {
      EXPECT_EQ(s.origin(h), v);
      EXPECT_TRUE(triangles.insert(Surface::triangle(h).value).second);
      if (last.valid()) {
        const Vec3 turn = cross(s.position(s.target(last)) - s.position(v), s.position(s.target(h)) - s.position(v));
        EXPECT_GT(turn.z, 0.0);
      }
      last = h;
    });
    visited += triangles.size();
  }
  EXPECT_EQ(visited, s.halfedgeCount());
}

TEST(Surface, RingHasTwoLoopsThatKeepTheSurfaceOnTheLeft) {
  const Surface s = ring(12);
  EXPECT_EQ(s.eulerCharacteristic(), 0);
  const std::vector<HalfedgeId> loops = s.boundaryLoops();
  ASSERT_EQ(loops.size(), 2U);
  for (const HalfedgeId first : loops) {
    double area = 0.0;
    int length = 0;
    HalfedgeId h = first;
    do {
      ASSERT_TRUE(s.isBoundary(h));
      area += 0.5 * cross(s.position(s.origin(h)), s.position(s.target(h))).z;
      ++length;
      h = s.nextBoundary(h);
    } while (h != first);
    EXPECT_EQ(length, 12);
    const double regular = 6.0 * math::sin(math::kPi / 6.0);
    const bool outer = norm(s.position(s.origin(first))) > 1.5;
    EXPECT_NEAR(area, outer ? 4.0 * regular : -regular, 1e-12);
  }
}

TEST(Surface, AnglesOfATriangleSumToPi) {
  const Surface s = ring(7);
  for (const TriangleId t : s.triangles()) {
    double sum = 0.0;
    for (int c = 0; c < 3; ++c) sum += s.angle(Surface::halfedge(t, c));
    EXPECT_NEAR(sum, math::kPi, 1e-14);
  }
  const Surface corner = Surface::build({{0, 0, 0}, {3, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}).value();
  EXPECT_NEAR(corner.angle(HalfedgeId(0)), 0.5 * math::kPi, 1e-15);
  EXPECT_EQ(corner.areaVector(TriangleId(0)), (Vec3{0.0, 0.0, 6.0}));
}

TEST(Surface, PointIsTheWeightedMeanOfTheCorners) {
  const Surface s = Surface::build(kTetrahedron, kTetrahedronSides).value();
  const Vec3 p = positionOf(s, {TriangleId(2), {0.5, 0.25, 0.25}});
  EXPECT_EQ(p, (Vec3{0.5, 0.25, 0.25}));
}

TEST(Surface, RefusesWhatIsNoManifold) {
  const auto codeOf = [](std::size_t vertices, const Triangles& triangles) {
    std::vector<Vec3> positions;
    for (std::size_t v = 0; v < vertices; ++v) {
      const auto x = static_cast<double>(v);
      positions.push_back({x, x * x, 0.0});
    }
    const auto result = Surface::build(positions, triangles);
    return result.ok() ? ErrorCode::internal : result.error().code;
  };
  EXPECT_EQ(codeOf(3, {{0, 1, 3}}), ErrorCode::indexOutOfRange);
  EXPECT_EQ(codeOf(3, {{0, -1, 2}}), ErrorCode::indexOutOfRange);
  EXPECT_EQ(codeOf(3, {{0, 1, 1}}), ErrorCode::malformedInput);
  EXPECT_EQ(codeOf(4, {{0, 1, 2}}), ErrorCode::malformedInput) << "isolated vertex";
  EXPECT_EQ(codeOf(4, {{0, 1, 2}, {0, 1, 3}}), ErrorCode::malformedInput) << "same direction";
  EXPECT_EQ(codeOf(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), ErrorCode::malformedInput) << "three triangles at an edge";
  EXPECT_EQ(codeOf(5, {{0, 1, 2}, {0, 3, 4}}), ErrorCode::malformedInput) << "two fans";
}

}  // namespace
}  // namespace qmcf
