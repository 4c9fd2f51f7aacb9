#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "qmcf/base/random.hpp"
#include "qmcf/topology/repair.hpp"
#include "topology/shapes.hpp"

namespace qmcf {
namespace {

/// Any triangles between a few points of a small lattice: every defect there is, in every combination.
TriangleMesh randomSoup(std::uint64_t seed, int points, int triangles) {
  Random random(seed);
  TriangleMesh mesh;
  for (int i = 0; i < points; ++i) {
    const auto coordinate = [&] { return static_cast<double>(random.next() % 3); };
    mesh.positions.push_back({coordinate(), coordinate(), coordinate()});
  }
  for (int i = 0; i < triangles; ++i) {
    const auto corner = [&] { return static_cast<std::int32_t>(random.next() % std::uint64_t(points)); };
    mesh.triangles.push_back({corner(), corner(), corner()});
  }
  return mesh;
}

TEST(RandomSoup, AlwaysGivesFacesThatAreSurfaces) {
  int usable = 0;
  for (std::uint64_t seed = 0; seed < 800; ++seed) {
    const TriangleMesh soup = randomSoup(seed, 4 + int(seed % 40), 1 + int(seed % 97));
    for (const bool modify : {true, false}) {
      SilentProgress silent;
      const auto result = repair(soup, {modify}, silent);
      if (!result) {
        EXPECT_EQ(result.error().code, ErrorCode::noSurface) << seed;
        continue;
      }
      ++usable;
      const TriangleMesh& mesh = result.value().mesh;
      for (const auto& c : mesh.triangles) {
        ASSERT_TRUE(c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) << seed;
        const auto at = [&](std::size_t i) { return mesh.positions[std::size_t(c[i])]; };
        if (modify) {
          EXPECT_GT(norm(cross(at(1) - at(0), at(2) - at(0))), 0.0) << seed;
        }
      }
      shapes::checkedBrep(mesh);
      if (HasFailure()) FAIL() << "seed " << seed << ", modify " << modify;
    }
  }
  EXPECT_GT(usable, 500);
}

TEST(RandomSoup, RepairIsIdempotent) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SilentProgress silent;
    const auto once = repair(randomSoup(seed, 4 + int(seed % 40), 1 + int(seed % 97)), {}, silent);
    if (!once) continue;
    // The middle of an edge may lie on another vertex.
    const auto& items = once.value().items;
    const bool halved = std::any_of(items.begin(), items.end(),
                                    [](const RepairItem& item) { return item.defect == "loneNonManifoldEdges"; });
    if (halved) continue;
    const auto twice = repair(once.value().mesh, {}, silent);
    ASSERT_TRUE(twice.ok());
    EXPECT_EQ(twice.value().mesh.triangles, once.value().mesh.triangles) << seed;
    EXPECT_EQ(twice.value().mesh.positions, once.value().mesh.positions) << seed;
  }
}

}  // namespace
}  // namespace qmcf
