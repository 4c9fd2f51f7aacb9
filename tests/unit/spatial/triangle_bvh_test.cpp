#include "qmcf/spatial/triangle_bvh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "qmcf/base/random.hpp"

namespace qmcf {
namespace {

using Triangles = std::vector<std::array<std::int32_t, 3>>;

struct Soup {
  std::vector<Vec3> positions;
  Triangles triangles;
};

Vec3 randomPoint(Random& random, double reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

Soup randomSoup(std::uint64_t seed, std::int32_t count) {
  Random random(seed);
  Soup soup;
  for (std::int32_t t = 0; t < count; ++t) {
    const Vec3 center = randomPoint(random, 1.0);
    for (int c = 0; c < 3; ++c) soup.positions.push_back(center + randomPoint(random, 0.2));
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return soup;
}

/// Squared distance by sampling barycentric coordinates finely: an upper bound that is close to the truth.
double sampledSquaredDistance(const Vec3& query, const Vec3& a, const Vec3& b, const Vec3& c, int steps) {
  double best = 1e300;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps - i; ++j) {
      const double u = static_cast<double>(i) / steps;
      const double v = static_cast<double>(j) / steps;
      best = std::min(best, squaredNorm(a * (1.0 - u - v) + b * u + c * v - query));
    }
  }
  return best;
}

TEST(ClosestPointOnTriangle, AgreesWithSampling) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a = randomPoint(random, 1.0);
    const Vec3 b = randomPoint(random, 1.0);
    const Vec3 c = randomPoint(random, 1.0);
    const Vec3 query = randomPoint(random, 2.0);
    const ClosestPoint closest = closestPointOnTriangle(query, a, b, c);
    const double sampled = sampledSquaredDistance(query, a, b, c, 60);
    EXPECT_LE(closest.squaredDistance, sampled + 1e-12);
    EXPECT_NEAR(std::sqrt(closest.squaredDistance), std::sqrt(sampled), 0.06);
    EXPECT_NEAR(closest.barycentric[0] + closest.barycentric[1] + closest.barycentric[2], 1.0, 1e-12);
    for (const double weight : closest.barycentric) EXPECT_GE(weight, 0.0);
  }
}

TEST(ClosestPointOnTriangle, TakesTrianglesWithoutArea) {
  const ClosestPoint onSegment = closestPointOnTriangle({1.0, 1.0, 0.0}, {}, {4.0, 0.0, 0.0}, {2.0, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(onSegment.squaredDistance, 1.0);
  EXPECT_NEAR(distance(onSegment.position, {1.0, 0.0, 0.0}), 0.0, 1e-15);
  const ClosestPoint onPoint = closestPointOnTriangle({0.0, 3.0, 4.0}, {}, {}, {});
  EXPECT_DOUBLE_EQ(onPoint.squaredDistance, 25.0);
}

TEST(TriangleBvh, FindsTheSameAsTryingAllTriangles) {
  const Soup soup = randomSoup(11, 500);
  const TriangleBvh bvh(soup.positions, soup.triangles);
  Random random(12);
  for (int i = 0; i < 500; ++i) {
    const Vec3 query = randomPoint(random, 1.5);
    double best = 1e300;
    for (const auto& t : soup.triangles) {
      best = std::min(best, closestPointOnTriangle(query, soup.positions[static_cast<std::size_t>(t[0])],
                                                   soup.positions[static_cast<std::size_t>(t[1])],
                                                   soup.positions[static_cast<std::size_t>(t[2])])
                                .squaredDistance);
    }
    const ClosestPoint found = bvh.closest(query);
    EXPECT_DOUBLE_EQ(found.squaredDistance, best);
    const auto& t = soup.triangles[static_cast<std::size_t>(found.triangle)];
    Vec3 position;
    for (std::size_t c = 0; c < 3; ++c)
      position += soup.positions[static_cast<std::size_t>(t[c])] * found.barycentric[c];
    EXPECT_NEAR(distance(position, found.position), 0.0, 1e-12);
  }
}

/// Thin triangles of every size far from the origin, where round-off is large and the normals of many are nearly noise.
Soup slivers(std::uint64_t seed, std::int32_t count) {
  Random random(seed);
  Soup soup;
  for (std::int32_t t = 0; t < count; ++t) {
    const Vec3 first = Vec3{1000.0, -500.0, 0.0} + randomPoint(random, 1.0);
    const Vec3 along = randomPoint(random, 0.5);
    const double thickness = std::pow(10.0, random.uniform(-12.0, -1.0));
    soup.positions.push_back(first);
    soup.positions.push_back(first + along);
    soup.positions.push_back(first + along * random.uniform(0.0, 1.0) + randomPoint(random, thickness));
    soup.triangles.push_back({6 * t, 6 * t + 1, 6 * t + 2});
    // A better one nearly touches its first side, so that little is enough to leave it out.
    soup.positions.push_back(first + along * 0.5 + randomPoint(random, 1e-9));
    for (int c = 0; c < 2; ++c) soup.positions.push_back(soup.positions.back() + randomPoint(random, 0.3));
    soup.triangles.push_back({6 * t + 3, 6 * t + 4, 6 * t + 5});
  }
  return soup;
}

TEST(TriangleBvh, LeavesOutNoSliver) {
  const Soup soup = slivers(31, 400);
  const TriangleBvh bvh(soup.positions, soup.triangles);
  Random random(32);
  for (int i = 0; i < 400; ++i) {
    // Every other query lies on a triangle or next to it.
    const auto& on = soup.triangles[static_cast<std::size_t>(2 * i)];
    const double step = i % 4 == 0 ? 0.0 : 1e-9;
    const Vec3 inside =
        (soup.positions[static_cast<std::size_t>(on[0])] + soup.positions[static_cast<std::size_t>(on[1])]) * 0.5;
    const Vec3 away{1000.0, -500.0, 0.0};
    const Vec3 query = i % 2 == 0 ? inside + randomPoint(random, 1.0) * step : away + randomPoint(random, 1.5);
    ClosestPoint best;
    best.squaredDistance = 1e300;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      const auto corner = [&](std::size_t c) { return soup.positions[static_cast<std::size_t>(soup.triangles[t][c])]; };
      const ClosestPoint closest = closestPointOnTriangle(query, corner(0), corner(1), corner(2));
      if (closest.squaredDistance >= best.squaredDistance) continue;
      best = closest;
      best.triangle = static_cast<std::int32_t>(t);
    }
    const ClosestPoint found = bvh.closest(query);
    EXPECT_EQ(found.triangle, best.triangle);
    EXPECT_EQ(found.squaredDistance, best.squaredDistance);
  }
}

TEST(TriangleBvh, TiesGoToTheSmallestTriangle) {
  // Twenty triangles around one common corner; the query is nearest to that corner of all.
  Soup soup;
  soup.positions.push_back({});
  for (std::int32_t i = 0; i < 20; ++i) {
    const double x = 1.0 + i;
    soup.positions.push_back({x, 0.0, 1.0});
    soup.positions.push_back({x, 1.0, 1.0});
    soup.triangles.push_back({0, 2 * i + 1, 2 * i + 2});
  }
  EXPECT_EQ(TriangleBvh(soup.positions, soup.triangles).closest({-1.0, -1.0, -3.0}).triangle, 0);
}

TEST(TriangleBvh, NormalFilterKeepsToTheSheet) {
  // Two parallel squares that face away from each other.
  const std::vector<Vec3> positions{{0, 0, 0},   {1, 0, 0},   {1, 1, 0},   {0, 1, 0},
                                    {0, 0, 0.1}, {1, 0, 0.1}, {1, 1, 0.1}, {0, 1, 0.1}};
  const Triangles triangles{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  const TriangleBvh bvh(positions, triangles);
  const Vec3 query{0.6, 0.3, 0.08};
  EXPECT_DOUBLE_EQ(bvh.closest(query).position.z, 0.1);
  EXPECT_DOUBLE_EQ(bvh.closest(query, {0.0, 0.0, -1.0}, 0.5).position.z, 0.0);
  // Nothing faces sideways: the filter gives way.
  EXPECT_DOUBLE_EQ(bvh.closest(query, {1.0, 0.0, 0.0}, 0.5).position.z, 0.1);
}

TEST(TriangleBvh, FindsWhetherAnyTriangleFacesAWay) {
  const Soup soup = randomSoup(15, 300);
  const TriangleBvh bvh(soup.positions, soup.triangles);
  Random random(16);
  int yes = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 query = randomPoint(random, 1.2);
    const Vec3 normal = randomPoint(random, 1.0);
    const double reach = random.uniform(0.0, 0.3);
    bool any = false;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      const auto corner = [&](std::size_t c) { return soup.positions[static_cast<std::size_t>(soup.triangles[t][c])]; };
      const ClosestPoint closest = closestPointOnTriangle(query, corner(0), corner(1), corner(2));
      any = any ||
            (closest.squaredDistance <= reach * reach && dot(bvh.normal(static_cast<std::int32_t>(t)), normal) > 0.0);
    }
    EXPECT_EQ(bvh.isAnyFacing(normal, query, reach), any);
    const ClosestPoint nearest = bvh.closestFacing(normal, query, reach);
    EXPECT_EQ(nearest.triangle >= 0, any);
    if (any) {
      EXPECT_EQ(nearest.triangle, bvh.closest(query, normal, 0.0).triangle);
    }
    yes += any ? 1 : 0;
  }
  EXPECT_GT(yes, 50);
  EXPECT_LT(yes, 250);
  EXPECT_FALSE(TriangleBvh({}, {}).isAnyFacing({0, 0, 1}, {}, 1.0));
}

TEST(TriangleBvh, HintChangesNothing) {
  const Soup soup = randomSoup(21, 300);
  const TriangleBvh bvh(soup.positions, soup.triangles);
  Random random(22);
  for (int i = 0; i < 300; ++i) {
    const Vec3 query = randomPoint(random, 1.5);
    const Vec3 normal = normalized(randomPoint(random, 1.0));
    const ClosestPoint plain = bvh.closest(query, normal, 0.3);
    const ClosestPoint hinted = bvh.closest(query, normal, 0.3, i);
    EXPECT_EQ(plain.triangle, hinted.triangle);
    EXPECT_EQ(plain.position, hinted.position);
  }
}

TEST(TriangleBvh, EmptyMeshIsEmpty) { EXPECT_TRUE(TriangleBvh({}, {}).empty()); }

}  // namespace
}  // namespace qmcf
